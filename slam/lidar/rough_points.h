#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "slam/lidar/sweep_surface.h"
#include "slam/points/selected_point.h"
#include "slam/tracking/patch_set.h"

namespace sparsight {

// Points whose surroundings are no plane have no one depth for the patch around them: edges of what
// stands in front of something else, poles, leaves. Between the rings of a sparse scanner nothing
// shows where such an edge is, and a patch that takes its texture from what is nearer makes each
// step seem longer. In the window they keep a fifth of their weight. `surface` of the same sweep.
void weigh_down_rough(std::vector<SelectedPoint>& points, const SweepSurface& surface,
                      const Eigen::Isometry3d& T_camera_lidar);

// For tracking, which has to tell what stands from what passes: trees and poles stand. `patches` of
// the points, at any levels. Real-time-safe.
void count_rough_fully(const std::vector<SelectedPoint>& points, std::vector<PatchSet>& patches);

}  // namespace sparsight
