#include "tools/evaluation/revisit_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "tools/evaluation/rotation_angle.h"

namespace sparsight {
namespace {

double distance_m(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.translation() - b.translation()).norm();
}

// The frame with which the first lap ends.
std::optional<std::size_t> end_of_lap(const std::vector<Eigen::Isometry3d>& truth,
                                      double radius_m) {
  constexpr double kAway = 5.0;
  bool away = false;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double from_start_m = distance_m(truth[i], truth.front());
    away = away || from_start_m > kAway * radius_m;
    if (away && from_start_m < radius_m) return i;
  }
  return std::nullopt;
}

// Of each time the path is within the radius, the frame that is nearest. It has left when it is
// twice as far away, so that a path along the rim passes once.
std::vector<std::size_t> passes_of(const std::vector<Eigen::Isometry3d>& truth, std::size_t place,
                                   double radius_m) {
  std::vector<std::size_t> passes;
  bool within = false;
  double nearest_m = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double away_m = distance_m(truth[i], truth[place]);
    if (away_m > 2.0 * radius_m) within = false;
    if (away_m >= radius_m) continue;
    if (!within) passes.push_back(i);
    if (!within || away_m < nearest_m) {
      passes.back() = i;
      nearest_m = away_m;
    }
    within = true;
  }
  return passes;
}

Revisit compared(const PosePairs& pairs, std::size_t first, std::size_t again) {
  const Eigen::Isometry3d motion_truth = pairs.truth[first].inverse() * pairs.truth[again];
  const Eigen::Isometry3d motion_estimate = pairs.estimate[first].inverse() * pairs.estimate[again];
  const Eigen::Isometry3d error = motion_truth.inverse() * motion_estimate;
  return {.first = first,
          .again = again,
          .error_m = error.translation().norm(),
          .error_deg = rotation_angle_rad(error.linear()) * 180.0 / std::numbers::pi};
}

}  // namespace

RevisitError revisit_error(const PosePairs& pairs, const RevisitOptions& options) {
  RevisitError error;
  if (options.places == 0 || pairs.truth.empty()) return error;
  const auto lap_end = end_of_lap(pairs.truth, options.radius_m);
  if (!lap_end) return error;
  const std::vector<double> way_m = path_distances_m(pairs.truth);
  double squares = 0.0;
  for (; error.places < options.places; ++error.places) {
    const double along_m =
        way_m[*lap_end] * static_cast<double>(error.places) / static_cast<double>(options.places);
    const auto place =
        static_cast<std::size_t>(std::ranges::lower_bound(way_m, along_m) - way_m.begin());
    const std::vector<std::size_t> passes = passes_of(pairs.truth, place, options.radius_m);
    for (std::size_t i = 1; i < passes.size(); ++i) {
      Revisit revisit = compared(pairs, passes.front(), passes[i]);
      revisit.place = error.places;
      revisit.way_m = way_m[passes[i]] - way_m[passes.front()];
      squares += revisit.error_m * revisit.error_m;
      error.max_m = std::max(error.max_m, revisit.error_m);
      error.revisits.push_back(revisit);
    }
  }
  if (!error.revisits.empty()) {
    error.rmse_m = std::sqrt(squares / static_cast<double>(error.revisits.size()));
  }
  return error;
}

}  // namespace sparsight
