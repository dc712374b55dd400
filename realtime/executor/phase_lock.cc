#include "realtime/executor/phase_lock.h"

#include <algorithm>
#include <cmath>

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

constexpr double kJitterMemory = 0.95;
constexpr double kJittersOfMargin = 2.0;

nanoseconds rounded(double ns) { return nanoseconds(std::llround(ns)); }

}  // namespace

nanoseconds PhaseLock::margin() const noexcept {
  return std::min(config_.most_margin, config_.margin + rounded(kJittersOfMargin * jitter_ns_));
}

// How far the next tick is from where it should be, to the nearest period: positive to wake later.
nanoseconds PhaseLock::error_of(HostTime ready, HostTime next) const noexcept {
  const double off = static_cast<double>((ready + margin() - next).count());
  return rounded(std::remainder(off, static_cast<double>(period_.count())));
}

nanoseconds PhaseLock::coast() const noexcept { return rounded(period_error_ns_); }

nanoseconds PhaseLock::observe(HostTime ready, HostTime next) noexcept {
  const nanoseconds error = error_of(ready, next);
  const double error_ns = static_cast<double>(error.count());
  const bool stray = std::abs(error_ns) > 0.25 * static_cast<double>(period_.count());
  strays_ = stray ? strays_ + 1 : 0;
  if (!begun_ || strays_ >= config_.strays_to_jump) {
    begun_ = true;
    strays_ = 0;
    in_phase_ = 0;
    return error;
  }
  if (stray) {
    in_phase_ = 0;
    return coast();
  }
  jitter_ns_ = kJitterMemory * jitter_ns_ + (1.0 - kJitterMemory) * std::abs(error_ns);
  in_phase_ = std::min(in_phase_ + 1, kInPhaseToLock);
  const double most = static_cast<double>(config_.most_step.count());
  const double most_period = 1e-3 * static_cast<double>(period_.count());  // crystals are better
  period_error_ns_ =
      std::clamp(period_error_ns_ + config_.period_gain * error_ns, -most_period, most_period);
  return rounded(std::clamp(config_.gain * error_ns, -most, most)) + coast();
}

}  // namespace sparsight
