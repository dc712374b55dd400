#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "hal/sweep.h"
#include "slam/geometry/camera_model.h"
#include "slam/geometry/se3.h"

namespace sparsight {

// A LiDAR return that falls into the image, seen from the camera at the exposure.
struct CameraReturn {
  Eigen::Vector3f p_camera;  // metres
  Eigen::Vector2f pixel;
  float intensity = 0.0F;
  std::uint16_t ring = 0;
};

// Sec. IV-B1: the returns in the camera frame. Of a sweep that is not motion-compensated each
// return is moved from its firing to the exposure with the camera's velocity `twist` ([rad/s, m/s],
// camera frame). Returns outside the image are dropped; the order is kept.
std::vector<CameraReturn> returns_in_image(const Sweep& sweep, const CameraModel& camera,
                                           const Eigen::Isometry3d& T_camera_lidar,
                                           const Vector6d& twist);

}  // namespace sparsight
