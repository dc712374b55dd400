#include "tools/evaluation/kitti_error.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tools/evaluation/rotation_angle.h"

namespace sparsight {
namespace {

constexpr double kKittiFramePeriod_s = 0.1;  // of a path without times
constexpr double kSpeedBinStep = 2.0;        // m/s; also the half width of a bin, as in the kit
constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

double duration_s(const PosePairs& pairs, std::size_t first, std::size_t last) {
  return pairs.times.empty() ? kKittiFramePeriod_s * static_cast<double>(last - first)
                             : to_seconds(pairs.times[last] - pairs.times[first]);
}

SegmentError segment_error(const PosePairs& pairs, std::size_t first, std::size_t last,
                           double length_m) {
  const Eigen::Isometry3d delta_truth = pairs.truth[first].inverse() * pairs.truth[last];
  const Eigen::Isometry3d delta_estimate = pairs.estimate[first].inverse() * pairs.estimate[last];
  const Eigen::Isometry3d error = delta_estimate.inverse() * delta_truth;
  const double duration = duration_s(pairs, first, last);
  return {.first = first,
          .last = last,
          .length_m = length_m,
          .translation_ratio = error.translation().norm() / length_m,
          .rotation_rad_per_m = rotation_angle_rad(error.linear()) / length_m,
          .speed_m_per_s = duration > 0.0 ? length_m / duration : 0.0};
}

template <typename Predicate>
SegmentMean mean_of(const std::vector<SegmentError>& segments, double key, Predicate belongs) {
  SegmentMean mean{.key = key};
  for (const SegmentError& segment : segments) {
    if (belongs(segment)) {
      ++mean.segments;
      mean.t_rel_percent += segment.translation_ratio;
      mean.r_rel_deg_per_m += segment.rotation_rad_per_m;
    }
  }
  if (mean.segments > 0) {
    mean.t_rel_percent *= 100.0 / static_cast<double>(mean.segments);
    mean.r_rel_deg_per_m *= kDegreesPerRadian / static_cast<double>(mean.segments);
  }
  return mean;
}

std::vector<SegmentMean> means_per_length(const std::vector<SegmentError>& segments,
                                          const std::vector<double>& lengths_m) {
  std::vector<SegmentMean> means;
  for (const double length : lengths_m) {
    const SegmentMean mean = mean_of(
        segments, length, [&](const SegmentError& segment) { return segment.length_m == length; });
    if (mean.segments > 0) {
      means.push_back(mean);
    }
  }
  return means;
}

std::vector<SegmentMean> means_per_speed(const std::vector<SegmentError>& segments) {
  double fastest = 0.0;
  for (const SegmentError& segment : segments) {
    fastest = std::max(fastest, segment.speed_m_per_s);
  }
  std::vector<SegmentMean> means;
  // The kit stops at 24 m/s, the speed of its own car; a wrong time must not make a million bins.
  const int bins = static_cast<int>(std::min(fastest / kSpeedBinStep, 100.0)) + 1;
  for (int bin = 1; bin <= bins; ++bin) {
    const double speed = kSpeedBinStep * bin;
    const SegmentMean mean = mean_of(segments, speed, [&](const SegmentError& segment) {
      return std::abs(segment.speed_m_per_s - speed) < kSpeedBinStep;
    });
    if (mean.segments > 0) {
      means.push_back(mean);
    }
  }
  return means;
}

}  // namespace

std::vector<double> path_distances_m(const std::vector<Eigen::Isometry3d>& poses) {
  std::vector<double> distances(poses.size(), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    distances[i] = distances[i - 1] + (poses[i].translation() - poses[i - 1].translation()).norm();
  }
  return distances;
}

KittiError kitti_error(const PosePairs& pairs, const SegmentOptions& options) {
  KittiError result;
  const std::vector<double> distances = path_distances_m(pairs.truth);
  for (std::size_t first = 0; first < pairs.truth.size(); first += options.step_frames) {
    for (const double length : options.lengths_m) {
      const auto beyond =
          std::upper_bound(distances.begin(), distances.end(), distances[first] + length);
      if (beyond != distances.end()) {
        const auto last = static_cast<std::size_t>(beyond - distances.begin());
        result.segments.push_back(segment_error(pairs, first, last, length));
      }
    }
  }
  if (!result.segments.empty()) {
    const SegmentMean all = mean_of(result.segments, 0.0, [](const auto&) { return true; });
    result.t_rel_percent = all.t_rel_percent;
    result.r_rel_deg_per_m = all.r_rel_deg_per_m;
  }
  result.per_length = means_per_length(result.segments, options.lengths_m);
  result.per_speed = means_per_speed(result.segments);
  return result;
}

}  // namespace sparsight
