#pragma once

#include <Eigen/Core>

#include "hal/calibration.h"

namespace sparsight {

// pi() of Sec. IV-A: pinhole with Brown–Conrady distortion, of one pyramid level. Real-time-safe.
class CameraModel {
 public:
  explicit CameraModel(const CameraIntrinsics& intrinsics);

  // The same camera looking at an image halved `level` times by 2x2 means.
  CameraModel at_level(int level) const;

  // Pixel of a point in the camera frame, whether or not inside the image. False, and no pixel, if
  // the point is behind the camera or so far off axis that the distortion model folds back.
  bool project(const Eigen::Vector3d& p_camera, Eigen::Vector2d& pixel) const;

  // Point on the pixel's ray at depth z = 1.
  Eigen::Vector3d unproject(const Eigen::Vector2d& pixel) const;

  // d_pixel / d_(normalised coordinates), for the Jacobian of the photometric residual.
  Eigen::Matrix2d d_pixel_d_normalized(const Eigen::Vector2d& normalized) const;

  bool contains(const Eigen::Vector2d& pixel, double border_px) const;

  const CameraIntrinsics& intrinsics() const { return intrinsics_; }
  // Squared radius in normalised coordinates up to which the distortion is one to one.
  double max_radius2() const { return max_radius2_; }

 private:
  Eigen::Vector2d distort(const Eigen::Vector2d& normalized) const;

  CameraIntrinsics intrinsics_;
  double max_radius2_;
};

}  // namespace sparsight
