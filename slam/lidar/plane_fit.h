#pragma once

#include <Eigen/Core>

namespace sparsight {

// Sums over points, from which a plane through them follows. They can be added to each other.
class PointMoments {
 public:
  void add(const Eigen::Vector3f& p) {
    const double x = p.x();
    const double y = p.y();
    const double z = p.z();
    sums_ += (Sums() << 1.0, x, y, z, x * x, x * y, x * z, y * y, y * z, z * z).finished();
  }
  void add(const PointMoments& other) { sums_ += other.sums_; }

  double count() const { return sums_(0); }
  Eigen::Vector3d mean() const { return sums_.segment<3>(1) / count(); }
  Eigen::Matrix3d covariance() const;

 private:
  using Sums = Eigen::Matrix<double, 10, 1>;  // 1, x, y, z, xx, xy, xz, yy, yz, zz
  Sums sums_ = Sums::Zero();
};

// The principal axes of a covariance, as a plane has them. Variances that rounding made negative
// are 0.
struct PlaneAxes {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit; zero: the points lie on a line
  Eigen::Vector3d extent = Eigen::Vector3d::Zero();  // rms along the axes, ascending
};
PlaneAxes plane_axes(const Eigen::Matrix3d& covariance);

// No more than the smallest eigenvalue: the first step towards it.
double least_variance(const Eigen::Matrix3d& covariance);

}  // namespace sparsight
