#include "realtime/executor/service_notifier.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace sparsight {
namespace {

std::optional<std::chrono::microseconds> watchdog_of_environment() {
  const char* pid = std::getenv("WATCHDOG_PID");
  if (pid != nullptr && std::strtol(pid, nullptr, 10) != getpid()) return std::nullopt;
  const char* text = std::getenv("WATCHDOG_USEC");
  const long long usec = text == nullptr ? 0 : std::strtoll(text, nullptr, 10);
  if (usec <= 0) return std::nullopt;
  return std::chrono::microseconds(usec);
}

}  // namespace

ServiceNotifier ServiceNotifier::from_environment() {
  const char* socket = std::getenv("NOTIFY_SOCKET");
  return {socket == nullptr ? "" : socket, watchdog_of_environment()};
}

ServiceNotifier::ServiceNotifier(std::string socket,
                                 std::optional<std::chrono::microseconds> watchdog)
    : socket_(std::move(socket)), watchdog_(watchdog) {
  const bool usable = socket_.size() > 1 && socket_.size() < sizeof(sockaddr_un::sun_path) &&
                      (socket_[0] == '/' || socket_[0] == '@');
  if (usable) fd_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

ServiceNotifier::~ServiceNotifier() {
  if (fd_ >= 0) close(fd_);
}

std::optional<std::chrono::microseconds> ServiceNotifier::watchdog_interval() const {
  if (!listening() || !watchdog_) return std::nullopt;
  return *watchdog_ / 2;
}

void ServiceNotifier::send(const std::string& message) const {
  if (!listening()) return;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, socket_.data(), socket_.size());
  if (address.sun_path[0] == '@') address.sun_path[0] = '\0';  // abstract (man 7 unix)
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket_.size());
  sendto(fd_, message.data(), message.size(), MSG_NOSIGNAL,
         reinterpret_cast<const sockaddr*>(&address), length);
}

}  // namespace sparsight
