#pragma once

#include <algorithm>
#include <cerrno>
#include <deque>
#include <map>
#include <vector>

#include "drivers/gpio/gpio_calls.h"

namespace sparsight::testing {

// GPIO lines on a clock that only waiting moves. Edges come at their times, each into its line's
// queue of 16, a while after its stamp.
class FakeGpio final : public GpioCalls {
 public:
  struct Line {
    std::deque<LineEvent> to_come;  // in the order of their times
    std::chrono::nanoseconds queued_after{0};
    std::deque<LineEvent> queue;
    std::size_t dropped = 0;
    WatchedEdges edges = WatchedEdges::kBoth;
    bool active_low = false;
  };
  std::map<unsigned, Line> lines;
  HostTime clock{std::chrono::seconds(100)};
  std::string chip;
  int watched = 0;
  int watch_errno = 0;
  int read_errno = 0;
  std::vector<HostTime> attempts;

  // From now on: high for `width`, each `period`.
  void add_pulses(unsigned line, int count, std::chrono::nanoseconds period,
                  std::chrono::nanoseconds width) {
    for (int i = 1; i <= count; ++i) {
      lines[line].to_come.push_back({true, clock + i * period});
      lines[line].to_come.push_back({false, clock + i * period + width});
    }
  }

  int watch(const std::string& path, unsigned line, WatchedEdges edges, bool active_low) override {
    attempts.push_back(clock);
    if (watch_errno != 0) return -watch_errno;
    chip = path;
    lines[line].edges = edges;
    lines[line].active_low = active_low;
    ++watched;
    return static_cast<int>(line);
  }
  void release(int) override { --watched; }

  int wait(std::span<const int> handles, std::chrono::nanoseconds patience) override {
    if (read_errno != 0) return 1;
    const HostTime deadline = clock + patience;
    while (queued(handles) == 0) {
      const HostTime next = next_arrival();
      clock = std::max(clock, std::min(next, deadline));
      arrive();
      if (next > deadline) break;
    }
    return queued(handles);
  }

  int read(int handle, std::span<LineEvent, kKernelQueue> events) override {
    if (read_errno != 0) return -read_errno;
    arrive();
    auto& queue = lines[static_cast<unsigned>(handle)].queue;
    const std::size_t count = std::min(queue.size(), events.size());
    std::copy_n(queue.begin(), count, events.begin());
    queue.erase(queue.begin(), queue.begin() + static_cast<std::ptrdiff_t>(count));
    return static_cast<int>(count);
  }
  void sleep(std::chrono::nanoseconds duration) override {
    clock += duration;
    arrive();
  }
  HostTime now() override { return clock; }

 private:
  int queued(std::span<const int> handles) {
    int ready = 0;
    for (const int handle : handles)
      ready += lines[static_cast<unsigned>(handle)].queue.empty() ? 0 : 1;
    return ready;
  }
  HostTime next_arrival() const {
    HostTime next = HostTime::max();
    for (const auto& [number, line] : lines) {
      if (!line.to_come.empty())
        next = std::min(next, line.to_come.front().time + line.queued_after);
    }
    return next;
  }
  void arrive() {
    for (auto& [number, line] : lines) {
      while (!line.to_come.empty() && line.to_come.front().time + line.queued_after <= clock) {
        const LineEvent event = line.to_come.front();
        line.to_come.pop_front();
        if (line.edges == WatchedEdges::kRising && !event.rising) continue;
        if (line.queue.size() < kKernelQueue) {
          line.queue.push_back(event);
        } else {
          ++line.dropped;
        }
      }
    }
  }
};

}  // namespace sparsight::testing
