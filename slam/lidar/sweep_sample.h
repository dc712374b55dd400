#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "hal/sweep.h"
#include "slam/geometry/se3.h"
#include "slam/lidar/sweep_surface.h"

namespace sparsight {

// A few hundred returns of a sweep that have a plane near them, spread evenly over it and over the
// directions that their planes face: taken as they come, most would lie on the floor. Of a sweep
// that is not motion-compensated each is moved to the exposure.
//
// twist: [rad/s, m/s], of the LiDAR, in its frame. `out` is in the LiDAR frame at the exposure,
// metres; with kMostSampled set aside in it, real-time-safe.
inline constexpr std::size_t kMostSampled = 450;
void sample_sweep(const Sweep& sweep, const Vector6d& twist, const SweepSurface& surface,
                  const Eigen::Isometry3d& T_keyframe_lidar, std::vector<Eigen::Vector3f>& out);

}  // namespace sparsight
