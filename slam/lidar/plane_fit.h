#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>

namespace sparsight {

// Sums over points, from which a plane through them follows. They can be added to each other.
class PointMoments {
 public:
  void add(const Eigen::Vector3f& p) {
    const Eigen::Vector3d q = p.cast<double>();
    sums_(0) += 1.0;
    sums_.segment<3>(1) += q;
    sums_.segment<3>(4) += q.x() * q;
    sums_.segment<2>(7) += q.y() * q.tail<2>();
    sums_(9) += q.z() * q.z();
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
// None if the points lie about the plane with more than `most_variance`.
std::optional<PlaneAxes> plane_axes(const Eigen::Matrix3d& covariance,
                                    double most_variance = std::numeric_limits<double>::infinity());

}  // namespace sparsight
