#include "tools/session/chart_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sparsight {
namespace {

double nice_step(double length, int most, bool whole_numbers) {
  const double least = length / std::max(most, 1);
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  double step = 10.0 * decade;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * decade >= least * (1.0 - 1e-9)) step = factor * decade;
  }
  return whole_numbers ? std::max(step, 1.0) : step;
}

// An interval of no length cannot be divided.
Interval with_some_length(Interval range) {
  if (range.empty()) return {0.0, 1.0};
  const double magnitude = std::max(std::abs(range.min), std::abs(range.max));
  const double least = std::max(1e-9 * magnitude, 1e-12);
  if (range.length() > least) return range;
  if (range.min >= 0.0 && range.max <= least) return {0.0, 1.0};
  const double half = 0.5 * std::max(std::abs(range.middle()), 1.0);
  return {range.middle() - half, range.middle() + half};
}

}  // namespace

void Interval::include(double value) {
  if (!std::isfinite(value)) return;
  min = std::min(min, value);
  max = std::max(max, value);
}

std::string Ticks::label(double position) const {
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  const double rounded = std::abs(position) < 1e-9 * step ? 0.0 : position;  // no "-0"
  return fmt::format("{:.{}f}", rounded, decimals);
}

Ticks nice_ticks(const Interval& range, int most, bool whole_numbers) {
  const Interval divided = with_some_length(range);
  Ticks ticks{.step = nice_step(divided.length(), most, whole_numbers)};
  const auto first = static_cast<long>(std::ceil(divided.min / ticks.step - 1e-9));
  const auto last = static_cast<long>(std::floor(divided.max / ticks.step + 1e-9));
  for (long i = first; i <= last; ++i)
    ticks.positions.push_back(static_cast<double>(i) * ticks.step);
  return ticks;
}

Interval widened_to_ticks(const Interval& range, int most) {
  const Interval divided = with_some_length(range);
  const double step = nice_step(divided.length(), most, false);
  return {std::floor(divided.min / step + 1e-9) * step,
          std::ceil(divided.max / step - 1e-9) * step};
}

}  // namespace sparsight
