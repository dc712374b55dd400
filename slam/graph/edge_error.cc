#include "slam/graph/edge_error.h"

#include <cmath>

namespace sparsight {
namespace {

constexpr double kSmallAngle = 1e-2;  // below: the first terms of the series, exact to 1e-13

// J^-1 = I - 1/2 phi^ + b phi^ phi^.
Eigen::Matrix3d inverse_left_jacobian_so3(const Eigen::Vector3d& phi) {
  const double angle = phi.norm();
  const double angle2 = angle * angle;
  const double b = angle < kSmallAngle
                       ? 1.0 / 12.0 + angle2 / 720.0 + angle2 * angle2 / 30240.0
                       : 1.0 / angle2 - (1.0 + std::cos(angle)) / (2.0 * angle * std::sin(angle));
  const Eigen::Matrix3d P = hat(phi);
  return Eigen::Matrix3d::Identity() - 0.5 * P + b * P * P;
}

// Barfoot's Q, eq. (7.86b): how a turn bends the translation.
Eigen::Matrix3d bend(const Eigen::Vector3d& phi, const Eigen::Vector3d& rho) {
  const double a = phi.norm();
  const double a2 = a * a;
  double c1 = 1.0 / 6.0 - a2 / 120.0 + a2 * a2 / 5040.0;
  double c2 = 1.0 / 24.0 - a2 / 720.0 + a2 * a2 / 40320.0;
  double c3 = 1.0 / 120.0 - a2 / 2520.0 + a2 * a2 / 120960.0;
  if (a >= kSmallAngle) {
    c1 = (a - std::sin(a)) / (a2 * a);
    c2 = (a2 + 2.0 * std::cos(a) - 2.0) / (2.0 * a2 * a2);
    c3 = (2.0 * a - 3.0 * std::sin(a) + a * std::cos(a)) / (2.0 * a2 * a2 * a);
  }
  const Eigen::Matrix3d P = hat(phi);
  const Eigen::Matrix3d V = hat(rho);
  const Eigen::Matrix3d turned = P * V * P;
  return 0.5 * V + c1 * (P * V + V * P + turned) + c2 * (P * P * V + V * P * P - 3.0 * turned) +
         c3 * (turned * P + P * turned);
}

}  // namespace

Vector6d edge_error(const Eigen::Isometry3d& T_world_from, const Eigen::Isometry3d& T_world_to,
                    const Eigen::Isometry3d& T_from_to) {
  return log_se3(T_world_from.inverse() * T_world_to * T_from_to.inverse());
}

double edge_chi2(const PoseGraph& graph, const PoseEdge& edge) {
  const Vector6d error =
      edge_error(graph.T_world_node[edge.from], graph.T_world_node[edge.to], edge.T_from_to);
  return error.dot(edge.information * error);
}

// With E = T_from^-1 T_to Z^-1: an increment of `from` gives exp(-eta) E, one of `to`
// E exp(Ad(Z) eta), and log(E exp(e)) = log E + J_l^-1(-log E) e.
EdgeJacobians edge_jacobians(const Vector6d& error, const Eigen::Isometry3d& T_from_to) {
  return {.d_error_d_from = -inverse_left_jacobian(error),
          .d_error_d_to = inverse_left_jacobian(-error) * adjoint(T_from_to)};
}

Matrix6d inverse_left_jacobian(const Vector6d& xi) {
  const Eigen::Matrix3d J_inverse = inverse_left_jacobian_so3(xi.head<3>());
  Matrix6d result = Matrix6d::Zero();
  result.topLeftCorner<3, 3>() = J_inverse;
  result.bottomRightCorner<3, 3>() = J_inverse;
  result.bottomLeftCorner<3, 3>() = -J_inverse * bend(xi.head<3>(), xi.tail<3>()) * J_inverse;
  return result;
}

}  // namespace sparsight
