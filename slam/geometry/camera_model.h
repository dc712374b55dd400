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

  // What the lens makes of normalised coordinates; Number is a number or an array of them.
  template <typename Number>
  void distort(const Number& x, const Number& y, Number& x_distorted, Number& y_distorted) const {
    const CameraIntrinsics& c = intrinsics_;
    const Number r2 = x * x + y * y;
    const Number radial = 1.0 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
    const Number xy = x * y;
    x_distorted = x * radial + 2.0 * c.p1 * xy + c.p2 * (r2 + 2.0 * x * x);
    y_distorted = y * radial + c.p1 * (r2 + 2.0 * y * y) + 2.0 * c.p2 * xy;
  }

  bool contains(const Eigen::Vector2d& pixel, double border_px) const;

  const CameraIntrinsics& intrinsics() const { return intrinsics_; }
  // Squared radius in normalised coordinates up to which the distortion is one to one.
  double max_radius2() const { return max_radius2_; }

 private:
  CameraIntrinsics intrinsics_;
  double max_radius2_;
};

}  // namespace sparsight
