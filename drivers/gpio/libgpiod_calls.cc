#include "drivers/gpio/libgpiod_calls.h"

#include <fcntl.h>
#include <gpiod.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <map>
#include <mutex>
#include <vector>

namespace sparsight {
namespace {

HostTime host_time(const timespec& time) {
  return HostTime(std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec));
}

timespec timespec_of(std::chrono::nanoseconds duration) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(duration);
  return {seconds.count(), (duration - seconds).count()};
}

int negative_errno() { return errno == 0 ? -EIO : -errno; }

class LibgpiodCalls final : public GpioCalls {
 public:
  int watch(const std::string& chip, unsigned line, WatchedEdges edges, bool active_low) override {
    gpiod_chip* opened = gpiod_chip_open(chip.c_str());
    if (!opened) return negative_errno();
    const int handle = request(opened, line, edges, active_low);
    if (handle < 0) {
      gpiod_chip_close(opened);
      return handle;
    }
    const std::lock_guard lock(mutex_);
    chips_[handle] = opened;
    return handle;
  }

  void release(int handle) override {
    const std::lock_guard lock(mutex_);
    const auto chip = chips_.find(handle);
    if (chip == chips_.end()) return;
    gpiod_chip_close(chip->second);  // and with it the line
    chips_.erase(chip);
  }

  int wait(std::span<const int> handles, std::chrono::nanoseconds patience) override {
    std::array<pollfd, 2> entries{};
    const std::size_t count = std::min(handles.size(), entries.size());
    for (std::size_t i = 0; i < count; ++i) entries[i] = {handles[i], POLLIN | POLLPRI, 0};
    const HostTime deadline = now() + patience;
    for (;;) {
      const timespec left = timespec_of(std::max(deadline - now(), std::chrono::nanoseconds(0)));
      const int ready = ::ppoll(entries.data(), count, &left, nullptr);
      if (ready >= 0) return ready;
      if (errno != EINTR) return negative_errno();
    }
  }

  int read(int handle, std::span<LineEvent, kKernelQueue> events) override {
    std::array<gpiod_line_event, kKernelQueue> raw{};
    const int count =
        gpiod_line_event_read_fd_multiple(handle, raw.data(), static_cast<unsigned>(raw.size()));
    if (count < 0) return errno == EAGAIN ? 0 : negative_errno();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      events[i] = {raw[i].event_type == GPIOD_LINE_EVENT_RISING_EDGE, host_time(raw[i].ts)};
    }
    return count;
  }

  void sleep(std::chrono::nanoseconds duration) override {
    timespec left = timespec_of(duration);
    while (::clock_nanosleep(CLOCK_MONOTONIC, 0, &left, &left) == EINTR) {
    }
  }

  HostTime now() override { return HostClock::now(); }

 private:
  // The line's file descriptor is its handle.
  static int request(gpiod_chip* chip, unsigned offset, WatchedEdges edges, bool active_low) {
    gpiod_line* line = gpiod_chip_get_line(chip, offset);
    if (!line) return negative_errno();
    const int flags = active_low ? GPIOD_LINE_REQUEST_FLAG_ACTIVE_LOW : 0;
    const int status = edges == WatchedEdges::kBoth
                           ? gpiod_line_request_both_edges_events_flags(line, "sparsight", flags)
                           : gpiod_line_request_rising_edge_events_flags(line, "sparsight", flags);
    if (status < 0) return negative_errno();
    const int fd = gpiod_line_event_get_fd(line);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the system's signature
    if (fd < 0 || ::fcntl(fd, F_SETFL, O_NONBLOCK) < 0) return negative_errno();
    return fd;
  }

  std::mutex mutex_;
  std::map<int, gpiod_chip*> chips_;
};

}  // namespace

GpioCalls& libgpiod_calls() {
  static LibgpiodCalls calls;
  return calls;
}

}  // namespace sparsight
