#pragma once

#include "hal/time.h"

namespace sparsight {

// What a loop waits by. Injected, so that a test decides when it is.
class LoopClock {
 public:
  virtual ~LoopClock() = default;
  virtual HostTime now() noexcept = 0;
  // At once if the time has passed.
  virtual void sleep_until(HostTime time) noexcept = 0;
};

// CLOCK_MONOTONIC, with sleeps to absolute times: what the work before took does not add up.
// Thread-safe, real-time-safe but for the sleep.
class MonotonicClock final : public LoopClock {
 public:
  HostTime now() noexcept override { return HostClock::now(); }
  void sleep_until(HostTime time) noexcept override;
};

}  // namespace sparsight
