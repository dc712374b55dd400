#pragma once

#include <vector>

#include "realtime/executor/loop_clock.h"

namespace sparsight {

// A clock that a test turns by hand; sleeping takes exactly as long as asked for.
class FakeClock final : public LoopClock {
 public:
  HostTime now() noexcept override { return now_; }
  void sleep_until(HostTime time) noexcept override {
    if (time > now_) now_ = time;
    ++sleeps;
  }
  void advance(std::chrono::nanoseconds by) { now_ += by; }

  int sleeps = 0;

 private:
  HostTime now_{std::chrono::seconds(1000)};
};

}  // namespace sparsight
