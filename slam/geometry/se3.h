#pragma once

#include <Eigen/Geometry>

namespace sparsight {

// Increments are [rotation, translation] = [omega, v], as xi in Sec. IV-A of the paper.
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

// Cross-product matrix: hat(a) * b = a x b.
Eigen::Matrix3d hat(const Eigen::Vector3d& a);

// Exponential map of eq. (2), exact for any angle (Barfoot, State Estimation for Robotics,
// Sec. 7.1.3). radians, metres.
Eigen::Isometry3d exp_se3(const Vector6d& xi);

// Inverse of exp_se3 for rotations below pi.
Vector6d log_se3(const Eigen::Isometry3d& T);

// T * exp(xi) = exp(adjoint(T) * xi) * T.
Matrix6d adjoint(const Eigen::Isometry3d& T);

// How far T turns, about whichever axis: 0 to 180.
double rotation_deg(const Eigen::Isometry3d& T);

// The nearest rigid transformation, against the rounding of long products.
Eigen::Isometry3d renormalized(const Eigen::Isometry3d& T);

}  // namespace sparsight
