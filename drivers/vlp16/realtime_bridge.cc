#include "drivers/vlp16/realtime_bridge.h"

#include <algorithm>
#include <ctime>
#include <limits>

namespace sparsight {
namespace {

using std::chrono::nanoseconds;
using namespace std::chrono_literals;

// A stamp farther than this from when it can have been taken says nothing.
constexpr nanoseconds kImplausible = 1s;

nanoseconds read_clock(clockid_t clock) {
  std::timespec now{};
  clock_gettime(clock, &now);
  return std::chrono::seconds(now.tv_sec) + nanoseconds(now.tv_nsec);
}

// How far a time lies outside of an interval.
nanoseconds outside(HostTime time, HostTime begin, HostTime end) {
  return std::max({begin - time, time - end, nanoseconds(0)});
}

}  // namespace

ClockPair read_clocks() {
  ClockPair best;
  nanoseconds shortest = nanoseconds::max();
  // An interruption between the readings shows as a long one.
  for (int attempt = 0; attempt < 3; ++attempt) {
    const nanoseconds before = read_clock(CLOCK_MONOTONIC);
    const nanoseconds realtime = read_clock(CLOCK_REALTIME);
    const nanoseconds after = read_clock(CLOCK_MONOTONIC);
    if (after - before >= shortest) continue;
    shortest = after - before;
    best = {realtime, HostTime(before + (after - before) / 2)};
  }
  return best;
}

void RealtimeBridge::update(const ClockPair& now) {
  const nanoseconds offset = now.monotonic.time_since_epoch() - now.realtime;
  offset_before_ = updated_ ? offset_ : offset;
  before_ = updated_ ? now_ : now.monotonic;
  offset_ = offset;
  now_ = now.monotonic;
  updated_ = true;
}

HostTime RealtimeBridge::to_host(nanoseconds realtime) const {
  const HostTime by_now(realtime + offset_);
  const HostTime by_before(realtime + offset_before_);
  const nanoseconds error = outside(by_now, before_, now_);
  const nanoseconds error_before = outside(by_before, before_, now_);
  if (std::min(error, error_before) > kImplausible) return now_;
  return std::min(error <= error_before ? by_now : by_before, now_);
}

}  // namespace sparsight
