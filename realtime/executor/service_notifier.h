#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace sparsight {

// Talks to systemd as a service of Type=notify (man sd_notify): datagrams of lines to a socket. By
// itself, without libsystemd: the protocol is that small. Does nothing where no service manager
// listens. Thread-safe.
class ServiceNotifier {
 public:
  // Of NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID in the environment.
  static ServiceNotifier from_environment();
  // socket: a path, or "@name" for an abstract one; "" for none.
  ServiceNotifier(std::string socket, std::optional<std::chrono::microseconds> watchdog);
  ~ServiceNotifier();
  ServiceNotifier(const ServiceNotifier&) = delete;
  ServiceNotifier& operator=(const ServiceNotifier&) = delete;

  bool listening() const { return fd_ >= 0; }
  // How often to feed: twice within what the service manager allows. Nothing if it does not watch.
  std::optional<std::chrono::microseconds> watchdog_interval() const;

  void ready() const { send("READY=1"); }
  void feed_watchdog() const { send("WATCHDOG=1"); }
  void stopping() const { send("STOPPING=1"); }
  void status(std::string_view line) const { send("STATUS=" + std::string(line)); }

 private:
  void send(const std::string& message) const;

  std::string socket_;
  std::optional<std::chrono::microseconds> watchdog_;
  int fd_ = -1;
};

}  // namespace sparsight
