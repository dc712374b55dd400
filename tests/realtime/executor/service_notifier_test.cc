#include "realtime/executor/service_notifier.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>

#include "realtime/executor/heartbeat.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;

// The service manager's end of the socket.
class Manager {
 public:
  Manager() : name_("@sparsight-test-" + std::to_string(getpid())) {
    fd_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, name_.data(), name_.size());
    address.sun_path[0] = '\0';
    const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name_.size());
    EXPECT_EQ(bind(fd_, reinterpret_cast<const sockaddr*>(&address), length), 0);
  }
  ~Manager() { close(fd_); }
  std::string heard() const {
    std::array<char, 256> buffer{};
    const ssize_t size = recv(fd_, buffer.data(), buffer.size(), 0);
    return size < 0 ? "nothing" : std::string(buffer.data(), static_cast<std::size_t>(size));
  }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  int fd_ = -1;
};

TEST(ServiceNotifier, SpeaksToTheManagerAsSdNotifyDoes) {
  const Manager manager;
  const ServiceNotifier notifier(manager.name(), 3s);
  notifier.ready();
  EXPECT_EQ(manager.heard(), "READY=1");
  notifier.status("tracking");
  EXPECT_EQ(manager.heard(), "STATUS=tracking");
  notifier.feed_watchdog();
  EXPECT_EQ(manager.heard(), "WATCHDOG=1");
  notifier.stopping();
  EXPECT_EQ(manager.heard(), "STOPPING=1");
  EXPECT_EQ(notifier.watchdog_interval(), 1500ms);
}

TEST(ServiceNotifier, IsSilentWhereNobodyListens) {
  const ServiceNotifier none("", 3s);
  EXPECT_FALSE(none.listening());
  EXPECT_FALSE(none.watchdog_interval().has_value());
  none.ready();
  const ServiceNotifier nonsense("not/absolute", std::nullopt);
  EXPECT_FALSE(nonsense.listening());
  const ServiceNotifier gone("/nowhere/at/all", std::nullopt);
  gone.ready();  // refused by the system; no matter
}

TEST(ServiceNotifier, ReadsTheEnvironment) {
  setenv("NOTIFY_SOCKET", "@sparsight-nobody", 1);
  setenv("WATCHDOG_USEC", "2000000", 1);
  setenv("WATCHDOG_PID", "1", 1);
  EXPECT_FALSE(ServiceNotifier::from_environment().watchdog_interval().has_value())
      << "the watchdog of another process";
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  EXPECT_EQ(ServiceNotifier::from_environment().watchdog_interval(), 1s);
  unsetenv("NOTIFY_SOCKET");
  unsetenv("WATCHDOG_USEC");
  unsetenv("WATCHDOG_PID");
  EXPECT_FALSE(ServiceNotifier::from_environment().listening());
}

TEST(LivenessCheck, NamesThoseThatStandStill) {
  Heartbeat a;
  Heartbeat b;
  LivenessCheck check;
  check.watch("a", a);
  check.watch("b", b);
  a.beat();
  EXPECT_EQ(check.standing_still(), std::vector<std::string>{"b"});
  a.beat();
  b.beat();
  EXPECT_TRUE(check.standing_still().empty());
  EXPECT_EQ(check.standing_still().size(), 2U);
}

}  // namespace
}  // namespace sparsight
