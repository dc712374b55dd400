#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "hal/time.h"
#include "slam/lidar/sweep_surface.h"
#include "slam/tracking/patch_set.h"

namespace sparsight {

// Of a keyframe, what a frame is tracked against.
struct TrackingTarget {
  std::uint64_t sequence = 0;
  HostTime exposure;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::vector<PatchSet> patches;    // per pyramid level
  double mean_inverse_depth = 0.0;  // 1/m, of the points
  SweepSurface surface;             // empty: nobody asks for it
};

}  // namespace sparsight
