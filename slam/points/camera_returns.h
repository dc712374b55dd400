#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
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

// T_exposure_time: where the camera was some seconds after the exposure (before it: negative), in
// the camera frame at the exposure.
using MotionAround = std::function<Eigen::Isometry3d(double seconds)>;
// twist: [rad/s, m/s] in the camera frame.
MotionAround constant_motion(const Vector6d& twist);

// Sec. IV-B1: the returns in the camera frame. Of a sweep that is not motion-compensated each
// return is moved from its firing to the exposure. Returns outside the image are dropped; the order
// is kept.
std::vector<CameraReturn> returns_in_image(const Sweep& sweep, const CameraModel& camera,
                                           const Eigen::Isometry3d& T_camera_lidar,
                                           const MotionAround& motion);

}  // namespace sparsight
