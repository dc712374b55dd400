#pragma once

#include <chrono>
#include <cstdint>

#include "hal/time.h"
#include "realtime/executor/loop_clock.h"

namespace sparsight {

struct LoopTick {
  HostTime due;
  HostTime woke;
  bool overran = false;        // the work before was not done when this tick was due
  std::uint64_t left_out = 0;  // ticks that passed altogether meanwhile
};

// Ticks on a grid of absolute times. Work that takes too long starts the next tick late, and costs
// those that passed altogether, but never moves the grid: the phase is kept. Thread-bound,
// real-time-safe but for the waiting.
class FixedRateLoop {
 public:
  FixedRateLoop(LoopClock& clock, std::chrono::nanoseconds period, HostTime first)
      : clock_(clock), period_(period), next_(first) {}

  // Waits for the next tick; at once if it has passed.
  LoopTick wait() noexcept;
  // Moves the grid from the next tick on; see PhaseLock.
  void shift(std::chrono::nanoseconds by) noexcept { next_ += by; }
  HostTime next() const noexcept { return next_; }
  std::chrono::nanoseconds period() const noexcept { return period_; }
  std::uint64_t overruns() const noexcept { return overruns_; }

 private:
  LoopClock& clock_;
  std::chrono::nanoseconds period_;
  HostTime next_;
  bool begun_ = false;
  std::uint64_t overruns_ = 0;
};

}  // namespace sparsight
