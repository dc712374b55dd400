#pragma once

#include <deque>
#include <optional>

#include "drivers/gpio/gpio_calls.h"
#include "hal/trigger_line.h"

namespace sparsight {

// One line: what the kernel has stamped of it and nobody has read yet. Released when it goes out of
// scope.
class WatchedLine {
 public:
  WatchedLine(GpioCalls& calls, int handle, EdgeLine line, WatchedEdges edges)
      : calls_(calls), handle_(handle), line_(line), edges_(edges) {}
  ~WatchedLine() { calls_.release(handle_); }
  WatchedLine(const WatchedLine&) = delete;
  WatchedLine& operator=(const WatchedLine&) = delete;

  int handle() const { return handle_; }

  // Takes all that the kernel holds: 0, or a negative errno.
  int drain(TriggerCounters& counters);

  bool empty() const { return waiting_.empty(); }
  HostTime first_time() const { return waiting_.front().time; }
  HostTime last_time() const { return waiting_.back().time; }
  // Counts it, too, if it goes the same way as the one before.
  Edge take_first(TriggerCounters& counters);

 private:
  GpioCalls& calls_;
  int handle_;
  EdgeLine line_;
  WatchedEdges edges_;
  std::deque<LineEvent> waiting_;
  std::optional<bool> last_rising_;
};

}  // namespace sparsight
