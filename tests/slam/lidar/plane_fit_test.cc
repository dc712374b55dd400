#include "slam/lidar/plane_fit.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/slam/random_values.h"

namespace sparsight {
namespace {

Eigen::Matrix3d any_covariance() {
  const Eigen::Matrix3d R = exp_se3(any_increment(3.0, 0.0)).linear();
  const auto rms = [] { return *rc::gen::element(0.0, 0.01, 0.02, 0.1, 0.3, 1.0, 5.0); };
  const Eigen::Vector3d extent(rms(), rms(), rms());
  return R * extent.cwiseAbs2().asDiagonal() * R.transpose();
}

RC_GTEST_PROP(PlaneAxes, AreThoseOfTheEigenvectors, ()) {
  const Eigen::Matrix3d c = any_covariance();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(c);
  const Eigen::Vector3d variances = principal.eigenvalues().cwiseMax(0.0);
  const PlaneAxes axes = plane_axes(c).value();
  const double trace = c.trace();
  // Roots that are alike are known to half of the digits, or to a third; of planes the smallest
  // counts.
  for (int i = 0; i < 3; ++i) {
    RC_ASSERT(std::abs(axes.extent(i) * axes.extent(i) - variances(i)) <= 2e-2 * trace);
  }
  const double rounding = 1e-10 * trace;
  if (variances(0) < 0.1 * variances(1) && variances(1) > 1e-4 * trace) {
    RC_ASSERT(std::abs(axes.extent(0) * axes.extent(0) - variances(0)) <= rounding);
  }
  RC_ASSERT(plane_axes(c, variances(0) + 2e-2 * trace + rounding).has_value());
  RC_ASSERT(!plane_axes(c, 0.9 * axes.extent(0) * axes.extent(0)) || axes.extent(0) == 0.0);
  // Of two alike, any direction between them is as good.
  if (variances(1) - variances(0) <= 1e-3 * trace) return;
  RC_ASSERT(std::abs(axes.normal.norm() - 1.0) < 1e-9);
  RC_ASSERT(std::abs(axes.normal.dot(principal.eigenvectors().col(0))) > 1.0 - 1e-6);
}

TEST(PlaneAxes, OfALineHaveNoNormalOrOneAcrossIt) {
  const Eigen::Vector3d along(1.0, 2.0, -0.5);
  const PlaneAxes axes = plane_axes(along * along.transpose()).value();
  EXPECT_NEAR(axes.extent.x(), 0.0, 1e-6);
  EXPECT_NEAR(axes.extent.z(), along.norm(), 1e-9);
  EXPECT_LT(std::abs(axes.normal.dot(along)), 1e-6);
  EXPECT_TRUE(plane_axes(Eigen::Matrix3d::Zero())->normal.isZero());
}

RC_GTEST_PROP(PointMoments, AreThoseOfAllPointsInAnyParts, ()) {
  const auto number = *rc::gen::inRange(3, 40);
  PointMoments parts[3];
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < number; ++i) {
    points.emplace_back(any_increment(60.0, 60.0).tail<3>().cast<float>().cast<double>());
    parts[i % 3].add(points.back().cast<float>());
  }
  parts[0].add(parts[1]);
  parts[0].add(parts[2]);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& p : points) mean += p / number;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& p : points) covariance += (p - mean) * (p - mean).transpose() / number;
  RC_ASSERT(parts[0].count() == number);
  RC_ASSERT((parts[0].mean() - mean).norm() < 1e-9);
  RC_ASSERT((parts[0].covariance() - covariance).norm() < 1e-8);
}

}  // namespace
}  // namespace sparsight
