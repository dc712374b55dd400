#include "slam/geometry/camera_model.h"

#include <Eigen/LU>
#include <cmath>

namespace sparsight {
namespace {

constexpr double kMinDepth = 1e-6;
constexpr double kWidestRadius2 = 100.0;  // 84 degrees off axis

// The radial function r * (1 + k1 r^2 + k2 r^4 + k3 r^6) grows up to here.
double one_to_one_radius2(const CameraIntrinsics& c) {
  if (!c.distorted()) return kWidestRadius2;
  constexpr double kStep = 0.01;
  for (double r2 = kStep; r2 < kWidestRadius2; r2 += kStep) {
    if (1.0 + r2 * (3.0 * c.k1 + r2 * (5.0 * c.k2 + r2 * 7.0 * c.k3)) <= 0.0) return r2 - kStep;
  }
  return kWidestRadius2;
}

}  // namespace

CameraModel::CameraModel(const CameraIntrinsics& intrinsics)
    : intrinsics_(intrinsics), max_radius2_(one_to_one_radius2(intrinsics)) {}

CameraModel CameraModel::at_level(int level) const {
  CameraModel result = *this;
  CameraIntrinsics& c = result.intrinsics_;
  for (int i = 0; i < level; ++i) {
    c.width /= 2;
    c.height /= 2;
    c.fx *= 0.5;
    c.fy *= 0.5;
    // A coarse pixel's centre lies between four fine ones.
    c.cx = (c.cx + 0.5) * 0.5 - 0.5;
    c.cy = (c.cy + 0.5) * 0.5 - 0.5;
  }
  return result;
}

bool CameraModel::project(const Eigen::Vector3d& p_camera, Eigen::Vector2d& pixel) const {
  if (!(p_camera.z() > kMinDepth)) return false;
  const Eigen::Vector2d normalized = p_camera.head<2>() / p_camera.z();
  if (!(normalized.squaredNorm() <= max_radius2_)) return false;  // NaN as well
  Eigen::Vector2d d = normalized;
  if (intrinsics_.distorted()) distort(normalized.x(), normalized.y(), d.x(), d.y());
  pixel = {intrinsics_.fx * d.x() + intrinsics_.cx, intrinsics_.fy * d.y() + intrinsics_.cy};
  return true;
}

Eigen::Vector3d CameraModel::unproject(const Eigen::Vector2d& pixel) const {
  const CameraIntrinsics& c = intrinsics_;
  const Eigen::Vector2d target{(pixel.x() - c.cx) / c.fx, (pixel.y() - c.cy) / c.fy};
  Eigen::Vector2d n = target;
  if (c.distorted()) {
    for (int i = 0; i < 20; ++i) {
      const Eigen::Matrix2d J = d_pixel_d_normalized(n);
      Eigen::Vector2d error;
      distort(n.x(), n.y(), error.x(), error.y());
      error -= target;
      const Eigen::Vector2d step =
          J.inverse() * Eigen::Vector2d(c.fx * error.x(), c.fy * error.y());
      n -= step;
      if (step.squaredNorm() < 1e-24) break;
    }
  }
  return n.homogeneous();
}

Eigen::Matrix2d CameraModel::d_pixel_d_normalized(const Eigen::Vector2d& n) const {
  const CameraIntrinsics& c = intrinsics_;
  const double x = n.x();
  const double y = n.y();
  const double r2 = n.squaredNorm();
  const double radial = 1.0 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  const double d_radial =
      2.0 * (c.k1 + r2 * (2.0 * c.k2 + r2 * 3.0 * c.k3));  // d radial / d r2 * 2
  Eigen::Matrix2d J;
  J(0, 0) = radial + x * x * d_radial + 2.0 * c.p1 * y + 6.0 * c.p2 * x;
  J(0, 1) = x * y * d_radial + 2.0 * c.p1 * x + 2.0 * c.p2 * y;
  J(1, 0) = J(0, 1);
  J(1, 1) = radial + y * y * d_radial + 6.0 * c.p1 * y + 2.0 * c.p2 * x;
  J.row(0) *= c.fx;
  J.row(1) *= c.fy;
  return J;
}

bool CameraModel::contains(const Eigen::Vector2d& pixel, double border_px) const {
  return pixel.x() >= border_px && pixel.y() >= border_px &&
         pixel.x() <= intrinsics_.width - 1 - border_px &&
         pixel.y() <= intrinsics_.height - 1 - border_px;
}

}  // namespace sparsight
