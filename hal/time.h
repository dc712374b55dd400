#pragma once

#include <chrono>

namespace sparsight {

// CLOCK_MONOTONIC of the host, the one clock of the system. A recorded data set's own time line
// takes its place when it is replayed.
struct HostClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<HostClock>;
  static constexpr bool is_steady = true;
  // libstdc++ reads CLOCK_MONOTONIC for its steady clock.
  static time_point now() {
    return time_point(std::chrono::steady_clock::now().time_since_epoch());
  }
};

// The LiDAR's own clock. Subtracting one clock's time from the other's does not compile.
struct SensorClock {
  using duration = std::chrono::nanoseconds;
  using rep = duration::rep;
  using period = duration::period;
  using time_point = std::chrono::time_point<SensorClock>;
  static constexpr bool is_steady = true;
};

using HostTime = std::chrono::time_point<HostClock, std::chrono::nanoseconds>;
using SensorTime = std::chrono::time_point<SensorClock, std::chrono::nanoseconds>;

inline double to_seconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}

}  // namespace sparsight
