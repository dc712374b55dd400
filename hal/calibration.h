#pragma once

#include <Eigen/Geometry>

namespace sparsight {

// Pinhole with Brown–Conrady distortion (Brown 1971; OpenCV's order k1 k2 p1 p2 k3). All
// coefficients zero is a rectified image. Pixels; the principal point counts from the centre of the
// top-left pixel.
struct CameraIntrinsics {
  int width = 0;
  int height = 0;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  double k1 = 0.0;
  double k2 = 0.0;
  double p1 = 0.0;
  double p2 = 0.0;
  double k3 = 0.0;

  bool distorted() const { return k1 != 0 || k2 != 0 || p1 != 0 || p2 != 0 || k3 != 0; }
};

// Camera frame: x right, y down, z forward. LiDAR frame: x forward, y left, z up. Metres.
struct RigCalibration {
  CameraIntrinsics camera;
  Eigen::Isometry3d T_camera_lidar = Eigen::Isometry3d::Identity();
};

}  // namespace sparsight
