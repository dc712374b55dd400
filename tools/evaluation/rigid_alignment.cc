#include "tools/evaluation/rigid_alignment.h"

#include <Eigen/SVD>

namespace sparsight {
namespace {

Eigen::Vector3d centroid(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) {
    sum += point;
  }
  return sum / static_cast<double>(points.size());
}

}  // namespace

Eigen::Isometry3d align_rigidly(const std::vector<Eigen::Vector3d>& target,
                                const std::vector<Eigen::Vector3d>& source) {
  const Eigen::Vector3d target_centre = centroid(target);
  const Eigen::Vector3d source_centre = centroid(source);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < target.size(); ++i) {
    covariance += (target[i] - target_centre) * (source[i] - source_centre).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  // Without this the best orthogonal matrix of a flat or straight path may be a reflection.
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  T_target_source.linear() =
      svd.matrixU() * Eigen::Vector3d(1.0, 1.0, sign).asDiagonal() * svd.matrixV().transpose();
  T_target_source.translation() = target_centre - T_target_source.linear() * source_centre;
  return T_target_source;
}

}  // namespace sparsight
