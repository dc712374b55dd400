#include "realtime/executor/fixed_rate_loop.h"

namespace sparsight {

LoopTick FixedRateLoop::wait() noexcept {
  LoopTick tick{.due = next_};
  const HostTime now = clock_.now();
  if (now > next_) {
    tick.left_out = static_cast<std::uint64_t>((now - next_) / period_);
    tick.due = next_ + static_cast<std::int64_t>(tick.left_out) * period_;
    tick.overran = begun_;
    tick.woke = now;
    if (begun_) ++overruns_;
  } else {
    clock_.sleep_until(next_);
    tick.woke = clock_.now();
  }
  begun_ = true;
  next_ = tick.due + period_;
  return tick;
}

}  // namespace sparsight
