#include "slam/lidar/plane_fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace sparsight {
namespace {

constexpr int kMostSteps = 40;      // of three alike each step leaves two thirds of the error
constexpr double kStepEnds = 1e-9;  // of the trace
// Of its square: with less the points lie on a line, and the smallest eigenvalue is rounding.
constexpr double kLeastMinors = 1e-12;

double sum_of_principal_minors(const Eigen::Matrix3d& c) {
  return c(0, 0) * c(1, 1) - c(0, 1) * c(0, 1) + c(0, 0) * c(2, 2) - c(0, 2) * c(0, 2) +
         c(1, 1) * c(2, 2) - c(1, 2) * c(1, 2);
}

// Newton's method from 0: the characteristic polynomial is convex there, so that no step passes the
// smallest root, and where a plane is thin two or three reach it. Once past `most` it goes no
// further.
double smallest_eigenvalue(const Eigen::Matrix3d& c, double trace, double minors, double most) {
  const double determinant = c.determinant();
  double root = 0.0;
  if (minors < kLeastMinors * trace * trace) return root;
  for (int i = 0; i < kMostSteps && root <= most; ++i) {
    const double value = determinant - root * (minors - root * (trace - root));
    const double slope = minors - root * (2.0 * trace - 3.0 * root);
    if (!(value > 0.0) || !(slope > 0.0)) break;
    const double step = value / slope;
    root += step;
    if (step < kStepEnds * trace) break;
  }
  return root;
}

// Of the matrix that has lost a rank: the longest product of two of its rows.
Eigen::Vector3d null_direction(const Eigen::Matrix3d& m) {
  const std::array<Eigen::Vector3d, 3> products{m.row(0).cross(m.row(1)), m.row(1).cross(m.row(2)),
                                                m.row(2).cross(m.row(0))};
  return *std::max_element(products.begin(), products.end(), [](const auto& a, const auto& b) {
    return a.squaredNorm() < b.squaredNorm();
  });
}

}  // namespace

Eigen::Matrix3d PointMoments::covariance() const {
  Eigen::Matrix3d squares;
  squares << sums_(4), sums_(5), sums_(6),  //
      sums_(5), sums_(7), sums_(8),         //
      sums_(6), sums_(8), sums_(9);
  const Eigen::Vector3d m = mean();
  return squares / count() - m * m.transpose();
}

std::optional<PlaneAxes> plane_axes(const Eigen::Matrix3d& c, double most_variance) {
  const double trace = c.trace();
  const double minors = sum_of_principal_minors(c);
  const double smallest = smallest_eigenvalue(c, trace, minors, most_variance);
  if (smallest > most_variance) return std::nullopt;
  // The two others, from their sum and their product.
  const double half = 0.5 * (trace - smallest);
  const double product = minors - smallest * 2.0 * half;
  const double apart = std::sqrt(std::max(0.0, half * half - product));
  const Eigen::Vector3d variances(smallest, half - apart, half + apart);
  PlaneAxes axes{.extent = variances.cwiseMax(0.0).cwiseSqrt()};
  const Eigen::Vector3d normal = null_direction(c - smallest * Eigen::Matrix3d::Identity());
  const double length = normal.norm();
  if (length > 0.0) axes.normal = normal / length;
  return axes;
}

}  // namespace sparsight
