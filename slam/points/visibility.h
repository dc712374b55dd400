#pragma once

#include <cstdint>
#include <vector>

#include "slam/geometry/camera_model.h"
#include "slam/points/camera_returns.h"

namespace sparsight {

// Marks returns whose patch would mix two surfaces: true where range jumps along the ring (as LOAM
// skips them: Zhang and Singh 2014, Sec. V-A), on both sides of the jump.
std::vector<bool> on_depth_edge(const std::vector<CameraReturn>& returns);

// Marks returns that the LiDAR sees but the camera, which stands elsewhere, does not: true where a
// much nearer return projects close by.
std::vector<bool> hidden_from_camera(const std::vector<CameraReturn>& returns,
                                     const CameraModel& camera);

}  // namespace sparsight
