#include "drivers/gpio/watched_line.h"

#include <algorithm>
#include <array>

namespace sparsight {

int WatchedLine::drain(TriggerCounters& counters) {
  std::array<LineEvent, kKernelQueue> events;
  for (;;) {
    const int count = calls_.read(handle_, events);
    if (count < 0) return count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      // Never backwards, or the merged lines would not be in order either.
      if (!waiting_.empty()) events[i].time = std::max(events[i].time, waiting_.back().time);
      waiting_.push_back(events[i]);
    }
    if (static_cast<std::size_t>(count) < kKernelQueue) return 0;
    ++counters.full_reads;
  }
}

Edge WatchedLine::take_first(TriggerCounters& counters) {
  const LineEvent event = waiting_.front();
  waiting_.pop_front();
  if (edges_ == WatchedEdges::kBoth && last_rising_ == event.rising) ++counters.repeated;
  last_rising_ = event.rising;
  ++counters.edges;
  return {.line = line_, .rising = event.rising, .time = event.time};
}

}  // namespace sparsight
