#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

#include "hal/time.h"

namespace sparsight {

// Poses of the same instants, in order: the ground truth's and the estimate's.
struct PosePairs {
  std::vector<Eigen::Isometry3d> truth;
  std::vector<Eigen::Isometry3d> estimate;
  std::vector<std::chrono::nanoseconds> times;  // of the truth; empty if unknown
};

struct SegmentOptions {
  std::vector<double> lengths_m = {100, 200, 300, 400, 500, 600, 700, 800};
  std::size_t step_frames = 10;  // a segment starts at every tenth frame
};

// One stretch of the path: from `first` to the first frame further than `length_m` along the truth.
struct SegmentError {
  std::size_t first = 0;
  std::size_t last = 0;
  double length_m = 0.0;
  double translation_ratio = 0.0;  // metres of error per metre of length
  double rotation_rad_per_m = 0.0;
  double speed_m_per_s = 0.0;
};

// The mean of all segments of one length, or of one range of speeds.
struct SegmentMean {
  double key = 0.0;  // the length in metres, or the middle of the speed bin in m/s
  std::size_t segments = 0;
  double t_rel_percent = 0.0;
  double r_rel_deg_per_m = 0.0;
};

struct KittiError {
  std::optional<double> t_rel_percent;  // none: the path holds no segment
  std::optional<double> r_rel_deg_per_m;
  std::vector<SegmentError> segments;
  std::vector<SegmentMean> per_length;  // only lengths that occur
  std::vector<SegmentMean> per_speed;   // bins of +-2 m/s around 2, 4, 6 ...; neighbours overlap
};

// Distance travelled up to each pose.
std::vector<double> path_distances_m(const std::vector<Eigen::Isometry3d>& poses);

// The error of the KITTI development kit (evaluate_odometry; Geiger et al., CVPR 2012): the overall
// figure is the mean over all segments of all lengths, so each length weighs by how often it
// occurs.
KittiError kitti_error(const PosePairs& pairs, const SegmentOptions& options);

}  // namespace sparsight
