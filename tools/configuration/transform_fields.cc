#include "tools/configuration/transform_fields.h"

#include <Eigen/SVD>
#include <cmath>

namespace sparsight {
namespace {

constexpr double kRoundedTo = 1e-3;

Eigen::Matrix3d linear_part(const TransformFields& fields) {
  Eigen::Matrix3d linear;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      linear(row, column) =
          (*fields.matrix)[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    }
  }
  return linear;
}

double distance_from_orthonormal(const Eigen::Matrix3d& R) {
  return (R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

// In the least-squares sense (Arun, Huang and Blostein 1987). A rotation stays as it is to the last
// bit, so that what was described is read back equal.
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& linear) {
  if (distance_from_orthonormal(linear) < 1e-12) return linear;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

Eigen::Quaterniond quaternion_of(const TransformFields& fields) {
  const auto& [w, x, y, z] = *fields.quaternion_wxyz;
  return {w, x, y, z};
}

}  // namespace

TransformFields fields_of(const Eigen::Isometry3d& T) {
  TransformFields fields;
  auto& matrix = fields.matrix.emplace();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      matrix[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
          T.matrix()(row, column);
    }
  }
  return fields;
}

Eigen::Isometry3d isometry_of(const TransformFields& fields) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  if (fields.matrix) {
    T.linear() = nearest_rotation(linear_part(fields));
    for (int row = 0; row < 3; ++row) {
      T.translation()[row] = (*fields.matrix)[static_cast<std::size_t>(row)][3];
    }
  } else {
    T.linear() = quaternion_of(fields).normalized().toRotationMatrix();
    T.translation() = Eigen::Vector3d(fields.translation_m->data());
  }
  return T;
}

bool is_unit_quaternion(const TransformFields& fields) {
  return !fields.quaternion_wxyz || std::abs(quaternion_of(fields).norm() - 1.0) < kRoundedTo;
}

bool is_rotation(const TransformFields& fields) {
  if (!fields.matrix) return true;
  const Eigen::Matrix3d R = linear_part(fields);
  return distance_from_orthonormal(R) < kRoundedTo && R.determinant() > 0.0;
}

}  // namespace sparsight
