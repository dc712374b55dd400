#include "tools/evaluation/association.h"

#include <fmt/format.h>

#include <algorithm>

namespace sparsight {
namespace {

// Index of the nearest of the sorted, non-empty times; the earliest of equals.
std::size_t nearest(const std::vector<HostTime>& times, HostTime time) {
  const auto after = std::lower_bound(times.begin(), times.end(), time);
  if (after == times.begin()) {
    return 0;
  }
  const auto before = std::lower_bound(times.begin(), after, *(after - 1));
  const bool take_before = after == times.end() || time - *before <= *after - time;
  return static_cast<std::size_t>((take_before ? before : after) - times.begin());
}

std::vector<IndexPair> associate_by_index(std::size_t count) {
  std::vector<IndexPair> pairs(count);
  for (std::size_t i = 0; i < count; ++i) {
    pairs[i] = {i, i};
  }
  return pairs;
}

double first_second(const Trajectory& trajectory) {
  return to_seconds(trajectory.times.front().time_since_epoch());
}

double last_second(const Trajectory& trajectory) {
  return to_seconds(trajectory.times.back().time_since_epoch());
}

}  // namespace

std::vector<IndexPair> associate_by_time(const std::vector<HostTime>& estimate,
                                         const std::vector<HostTime>& truth,
                                         std::chrono::nanoseconds tolerance) {
  std::vector<IndexPair> pairs;
  if (truth.empty()) {
    return pairs;
  }
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    const std::size_t partner = nearest(truth, estimate[i]);
    const bool close = std::chrono::abs(truth[partner] - estimate[i]) <= tolerance;
    if (close && nearest(estimate, truth[partner]) == i) {
      pairs.push_back({i, partner});
    }
  }
  return pairs;
}

Result<std::vector<IndexPair>> associate(const Trajectory& estimate, const Trajectory& truth,
                                         std::chrono::nanoseconds tolerance) {
  if (estimate.times.empty() && truth.times.empty()) {
    return associate_by_index(std::min(estimate.poses.size(), truth.poses.size()));
  }
  if (estimate.times.empty() || truth.times.empty()) {
    const Trajectory& timeless = estimate.times.empty() ? estimate : truth;
    const Trajectory& timed = estimate.times.empty() ? truth : estimate;
    return fail(ErrorCode::kMissingField,
                fmt::format("{} has no times and {} has: give the times of the first with --times "
                            "FILE (times.txt of a KITTI sequence)",
                            timeless.source, timed.source));
  }
  auto pairs = associate_by_time(estimate.times, truth.times, tolerance);
  if (pairs.empty()) {
    return fail(
        ErrorCode::kOutOfRange,
        fmt::format("no pose of {} ({:.6f} to {:.6f} s) has a partner in {} ({:.6f} to "
                    "{:.6f} s) within {} s; are both on the same clock? "
                    "(--max-time-difference widens the search)",
                    estimate.source, first_second(estimate), last_second(estimate), truth.source,
                    first_second(truth), last_second(truth), to_seconds(tolerance)));
  }
  return pairs;
}

}  // namespace sparsight
