#pragma once

#include <Eigen/Core>

#include "hal/calibration.h"

namespace sparsight::simulated {

// Where a point of the plane z = 1 is seen, in pixels.
Eigen::Vector2d project(const CameraIntrinsics& camera, const Eigen::Vector2d& on_plane);

// The point of the plane z = 1 that is seen at a pixel.
Eigen::Vector2d unproject(const CameraIntrinsics& camera, const Eigen::Vector2d& pixel);

}  // namespace sparsight::simulated
