#include "drivers/v4l2/system_calls.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

namespace sparsight {
namespace {

timespec timespec_of(std::chrono::nanoseconds duration) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(duration);
  return {seconds.count(), (duration - seconds).count()};
}

class LinuxCalls final : public SystemCalls {
 public:
  int open(const std::string& path) override {
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the system's signature
    const int fd = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    return fd < 0 ? -errno : fd;
  }
  void close(int fd) override { ::close(fd); }

  int ioctl(int fd, unsigned long request, void* argument) override {
    int result = 0;
    do {
      result = ::ioctl(fd, request, argument);
    } while (result < 0 && errno == EINTR);
    return result < 0 ? -errno : result;
  }

  void* map(int fd, std::size_t length, std::uint32_t offset) override {
    // Populated: the first frame must not wait for page faults.
    void* address = ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, fd,
                           static_cast<off_t>(offset));
    return address == MAP_FAILED ? nullptr : address;
  }
  void unmap(void* address, std::size_t length) override { ::munmap(address, length); }

  int poll(int fd, short events, std::chrono::nanoseconds patience) override {
    const HostTime deadline = now() + patience;
    for (;;) {
      const auto left = std::max(deadline - now(), std::chrono::nanoseconds(0));
      const timespec timeout = timespec_of(left);
      pollfd entry{.fd = fd, .events = events, .revents = 0};
      const int ready = ::ppoll(&entry, 1, &timeout, nullptr);
      if (ready >= 0) return ready == 0 ? 0 : entry.revents;
      if (errno != EINTR) return -errno;
    }
  }

  void sleep(std::chrono::nanoseconds duration) override {
    timespec left = timespec_of(duration);
    while (::clock_nanosleep(CLOCK_MONOTONIC, 0, &left, &left) == EINTR) {
    }
  }

  HostTime now() override { return HostClock::now(); }
};

}  // namespace

SystemCalls& linux_calls() {
  static LinuxCalls calls;
  return calls;
}

}  // namespace sparsight
