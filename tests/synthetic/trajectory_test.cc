#include "tests/synthetic/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sparsight::synthetic {
namespace {

TEST(CubicSpline, PassesThroughItsValues) {
  const std::vector<double> values{1.0, -2.0, 4.0, 0.5, 3.0};
  const CubicSpline spline(values, 10.0, 0.5);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(spline(10.0 + 0.5 * static_cast<double>(i)), values[i], 1e-12);
  }
}

TEST(CubicSpline, ReproducesAStraightLineBetweenValues) {
  const CubicSpline spline({0.0, 2.0, 4.0, 6.0}, 0.0, 1.0);
  EXPECT_NEAR(spline(1.37), 2.74, 1e-12);
}

TEST(CubicSpline, SlopeAndCurvatureDoNotJumpAtAValue) {
  const CubicSpline spline({1.0, -2.0, 4.0, 0.5, 3.0}, 0.0, 1.0);
  constexpr double kStep = 1e-4;
  const auto slope = [&](double x) { return (spline(x + kStep) - spline(x - kStep)) / 2 / kStep; };
  const auto curvature = [&](double x) {
    return (spline(x + kStep) - 2 * spline(x) + spline(x - kStep)) / kStep / kStep;
  };
  for (const double knot : {1.0, 2.0, 3.0}) {
    EXPECT_NEAR(slope(knot - 2 * kStep), slope(knot + 2 * kStep), 0.02);
    EXPECT_NEAR(curvature(knot - 2 * kStep), curvature(knot + 2 * kStep), 0.05);
  }
}

TEST(Attitude, YawTurnsLeftPitchDipsTheNoseRollLowersTheRight) {
  Attitude left;
  left.yaw = 0.1;
  EXPECT_GT((left.pose().linear() * Eigen::Vector3d::UnitX()).y(), 0.0);
  Attitude down;
  down.pitch = 0.1;
  EXPECT_LT((down.pose().linear() * Eigen::Vector3d::UnitX()).z(), 0.0);
  Attitude right;
  right.roll = 0.1;
  EXPECT_LT((right.pose().linear() * -Eigen::Vector3d::UnitY()).z(), 0.0);
}

TEST(Trajectory, ShakeMovesInTheDirectionOfTravel) {
  Attitude facing_left;
  facing_left.yaw = M_PI / 2.0;
  Trajectory trajectory({facing_left, facing_left, facing_left}, 0.0, 1.0);
  trajectory.shake = [](double) {
    Attitude a;
    a.position = {0.5, 0.0, 0.0};
    return a;
  };
  EXPECT_TRUE(trajectory(1.0).translation().isApprox(Eigen::Vector3d(0.0, 0.5, 0.0), 1e-12));
}

}  // namespace
}  // namespace sparsight::synthetic
