#pragma once

#include <functional>
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
    if (after_sleep) after_sleep();
  }
  void advance(std::chrono::nanoseconds by) { now_ += by; }

  int sleeps = 0;
  std::function<void()> after_sleep;  // what happens before the sleeper has the processor again

 private:
  HostTime now_{std::chrono::seconds(1000)};
};

}  // namespace sparsight
