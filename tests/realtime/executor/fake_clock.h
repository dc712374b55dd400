#pragma once

#include <functional>
#include <vector>

#include "realtime/executor/loop_clock.h"

namespace sparsight {

// A clock that a test turns by hand; sleeping takes exactly as long as asked for.
class FakeClock final : public LoopClock {
 public:
  HostTime now() noexcept override { return now_ += each_look; }
  void sleep_until(HostTime time) noexcept override {
    if (time > now_) now_ = time;
    ++sleeps;
    if (after_sleep) after_sleep();
  }
  void advance(std::chrono::nanoseconds by) { now_ += by; }

  int sleeps = 0;
  std::chrono::nanoseconds each_look{0};  // takes so long: a stand-in for what is done in between
  std::function<void()> after_sleep;      // what happens before the sleeper has the processor again

 private:
  HostTime now_{std::chrono::seconds(1000)};
};

}  // namespace sparsight
