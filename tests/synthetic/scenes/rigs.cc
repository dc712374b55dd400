#include "tests/synthetic/scenes/rigs.h"

namespace sparsight::synthetic {
namespace {

// Camera axes (right, down, forward) from body axes (forward, left, up), then a mounting error of a
// few milliradians, as a calibration finds it.
Eigen::Isometry3d mount(const Eigen::Vector3d& t_camera_lidar, const Eigen::Vector3d& tilt_rad) {
  Eigen::Matrix3d axes;
  axes << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  if (tilt_rad.norm() > 0.0) {
    T.linear() = Eigen::AngleAxisd(tilt_rad.norm(), tilt_rad.normalized()).toRotationMatrix();
  }
  T.linear() = T.linear() * axes;
  T.translation() = t_camera_lidar;
  return T;
}

}  // namespace

RigCalibration kitti_rig() {
  return {{1226, 370, 707.0912, 707.0912, 601.8873, 183.1104},
          mount({-0.005, -0.073, -0.334}, {0.0018, -0.0065, 0.0080})};
}

RigCalibration hand_held_rig() {
  return {{800, 600, 400.0, 400.0, 401.3, 297.6},
          mount({0.01, -0.10, -0.04}, {0.004, 0.007, -0.005})};
}

RigCalibration rgbd_rig() {
  return {{640, 480, 525.0, 525.0, 319.5, 239.5}, mount({0, 0, 0}, {0, 0, 0})};
}

}  // namespace sparsight::synthetic
