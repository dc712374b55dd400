#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <span>

#include "slam/geometry/se3.h"
#include "slam/lidar/sweep_surface.h"

namespace sparsight {

// How a sweep lies on a keyframe's surface, from some pose.
struct SweepFit {
  Eigen::Isometry3d T_keyframe_lidar = Eigen::Isometry3d::Identity();
  // Of the returns that have a plane near, by the area they stand for, those that lie on it.
  double share = 0.0;
  std::size_t returns = 0;  // that have one
  // Sum of n n^T over the returns on it, n their plane's normal: how many speak for a direction.
  Eigen::Matrix3d facing = Eigen::Matrix3d::Zero();
  Matrix6d information = Matrix6d::Zero();  // left increment of T_keyframe_lidar
};

// Point to plane, weights of eq. (5). Returns count by the area they stand for, which grows with
// the square of the distance, up to twice their median distance: a bus alongside has many returns
// and little area. `returns` in the LiDAR frame at the exposure, metres. Real-time-safe.
SweepFit fit_of_sweep(const SweepSurface& surface, std::span<const Eigen::Vector3f> returns,
                      const Eigen::Isometry3d& T_keyframe_lidar);
SweepFit align_sweep(const SweepSurface& surface, std::span<const Eigen::Vector3f> returns,
                     const Eigen::Isometry3d& start);

}  // namespace sparsight
