#pragma once

#include <Eigen/Core>
#include <optional>

#include "hal/calibration.h"

namespace sparsight::synthetic {

// Written apart from the program's own camera model, so that one checks the other.

// Direction (unit length, camera frame) a pixel looks along.
Eigen::Vector3d pixel_direction(const CameraIntrinsics& camera, const Eigen::Vector2d& pixel);

// Nothing where the point is behind the camera.
std::optional<Eigen::Vector2d> project(const CameraIntrinsics& camera,
                                       const Eigen::Vector3d& p_camera);

}  // namespace sparsight::synthetic
