#include "slam/geometry/se3.h"

#include <cmath>

namespace sparsight {
namespace {

constexpr double kSmallAngle = 1e-5;

// V of t = V * v, i.e. the left Jacobian of SO(3).
Eigen::Matrix3d left_jacobian_so3(const Eigen::Vector3d& omega) {
  const double angle = omega.norm();
  const Eigen::Matrix3d W = hat(omega);
  if (angle < kSmallAngle) return Eigen::Matrix3d::Identity() + 0.5 * W + W * W / 6.0;
  const double a2 = angle * angle;
  return Eigen::Matrix3d::Identity() + (1.0 - std::cos(angle)) / a2 * W +
         (angle - std::sin(angle)) / (a2 * angle) * W * W;
}

// Rotation vector; through the quaternion, which stays accurate near zero and near pi.
Eigen::Vector3d log_so3(const Eigen::Matrix3d& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sin_half = q.vec().norm();
  if (sin_half < kSmallAngle) return 2.0 * q.vec() / q.w();
  return 2.0 * std::atan2(sin_half, q.w()) / sin_half * q.vec();
}

}  // namespace

Eigen::Matrix3d hat(const Eigen::Vector3d& a) {
  Eigen::Matrix3d A;
  A << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return A;
}

Eigen::Isometry3d exp_se3(const Vector6d& xi) {
  const Eigen::Vector3d omega = xi.head<3>();
  const double angle = omega.norm();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  if (angle > 0.0) T.linear() = Eigen::AngleAxisd(angle, omega / angle).toRotationMatrix();
  T.translation() = left_jacobian_so3(omega) * xi.tail<3>();
  return T;
}

Vector6d log_se3(const Eigen::Isometry3d& T) {
  Vector6d xi;
  xi.head<3>() = log_so3(T.linear());
  const Eigen::Matrix3d V = left_jacobian_so3(xi.head<3>());
  xi.tail<3>() = V.inverse() * T.translation();
  return xi;
}

Matrix6d adjoint(const Eigen::Isometry3d& T) {
  Matrix6d A = Matrix6d::Zero();
  A.topLeftCorner<3, 3>() = T.linear();
  A.bottomRightCorner<3, 3>() = T.linear();
  A.bottomLeftCorner<3, 3>() = hat(T.translation()) * T.linear();
  return A;
}

double rotation_deg(const Eigen::Isometry3d& T) {
  return Eigen::AngleAxisd(T.linear()).angle() * 180.0 / M_PI;
}

Eigen::Isometry3d renormalized(const Eigen::Isometry3d& T) {
  Eigen::Isometry3d result = T;
  result.linear() = Eigen::Quaterniond(T.linear()).normalized().toRotationMatrix();
  return result;
}

}  // namespace sparsight
