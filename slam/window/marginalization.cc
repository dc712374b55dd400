#include "slam/window/marginalization.h"

#include <Eigen/Eigenvalues>

namespace sparsight {
namespace {

constexpr double kUnconstrained = 1e-10;  // eigenvalue, as a share of the largest

Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& A) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (A + A.transpose()));
  const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
  const Eigen::VectorXd inverse = eigen.eigenvalues().unaryExpr(
      [&](double value) { return value > kUnconstrained * largest ? 1.0 / value : 0.0; });
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

Quadratic without_first(const Quadratic& energy) {
  const Eigen::Index kept = energy.b.size() - 6;
  const Eigen::MatrixXd H_km = energy.H.bottomLeftCorner(kept, 6);
  const Eigen::MatrixXd gain = H_km * pseudo_inverse(energy.H.topLeftCorner<6, 6>());
  Quadratic result;
  const Eigen::MatrixXd H = energy.H.bottomRightCorner(kept, kept) - gain * H_km.transpose();
  result.H = 0.5 * (H + H.transpose());
  result.b = energy.b.tail(kept) - gain * energy.b.head<6>();
  return result;
}

Matrix6d information_of_second(const Quadratic& energy) {
  const Eigen::Index others = energy.b.size() - 12;
  Matrix6d H_ss = energy.H.block<6, 6>(6, 6);
  if (others <= 0) return H_ss;
  const Eigen::MatrixXd H_os = energy.H.block(12, 6, others, 6);
  const Matrix6d information =
      H_ss - H_os.transpose() * pseudo_inverse(energy.H.bottomRightCorner(others, others)) * H_os;
  return 0.5 * (information + information.transpose());
}

}  // namespace sparsight
