#pragma once

#include <chrono>

#include "hal/time.h"

namespace sparsight {

struct PhaseLockConfig {
  std::chrono::nanoseconds margin{1'000'000};       // a tick comes so long after a frame is ready
  std::chrono::nanoseconds most_margin{4'000'000};  // with what frames jitter on top
  double gain = 0.05;                               // share of the error that one frame corrects
  double period_gain = 0.002;                       // and of what it says about the period
  std::chrono::nanoseconds most_step{500'000};      // of the phase, by one frame
  int strays_to_jump = 8;  // in a row, off by more than a quarter of the period
};

// Keeps a loop in phase with the camera's trigger: from when frames become ready it tells by how
// much the next tick should move, so that the loop wakes just after a frame is due. Slow, so that a
// late frame does not pull it; it jumps at the start, and when eight in a row say that the phase is
// another. Thread-bound, real-time-safe.
class PhaseLock {
 public:
  explicit PhaseLock(std::chrono::nanoseconds period, const PhaseLockConfig& config = {})
      : period_(period), config_(config) {}

  // A frame became ready; `next` is when the next tick is due. Returns the shift for it.
  std::chrono::nanoseconds observe(HostTime ready, HostTime next) noexcept;
  // The correction for one tick without a frame: the period that was learned.
  std::chrono::nanoseconds coast() const noexcept;
  bool locked() const noexcept { return in_phase_ >= kInPhaseToLock; }
  std::chrono::nanoseconds margin() const noexcept;

 private:
  static constexpr int kInPhaseToLock = 8;

  std::chrono::nanoseconds error_of(HostTime ready, HostTime next) const noexcept;

  std::chrono::nanoseconds period_;
  PhaseLockConfig config_;
  double period_error_ns_ = 0.0;  // of the period given: learned
  double jitter_ns_ = 0.0;        // mean distance from where a frame was expected
  bool begun_ = false;
  int strays_ = 0;
  int in_phase_ = 0;
};

}  // namespace sparsight
