#include "slam/tracking/starting_motions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <span>

#include "slam/geometry/se3.h"

namespace sparsight {
namespace {

bool any_like(std::span<const Eigen::Isometry3d> starts, const Eigen::Isometry3d& T) {
  return std::any_of(starts.begin(), starts.end(), [&](const Eigen::Isometry3d& start) {
    return (start.matrix() - T.matrix()).norm() < 1e-9;
  });
}

class StartingMotions : public testing::Test {
 protected:
  static Eigen::Isometry3d moved(double amount) {
    Vector6d xi;
    xi << 0.01, 0.05, -0.02, 0.1, 0.0, 0.8;
    return exp_se3(amount * xi);
  }
  const Eigen::Isometry3d T_previous_ = exp_se3(Vector6d::Constant(0.2));
  const Eigen::Isometry3d T_predicted_ = T_previous_ * moved(1.0);
};

TEST_F(StartingMotions, BeginWithThePredictionThenWithStandingStill) {
  const auto starts = starting_motions(T_previous_, T_predicted_, 10.0);
  ASSERT_GE(starts.size(), 4U);
  EXPECT_EQ(starts[0].matrix(), T_predicted_.matrix());
  EXPECT_EQ(starts[1].matrix(), T_previous_.matrix());
}

TEST_F(StartingMotions, KnowBrakingAndDoubling) {
  const auto starts = starting_motions(T_previous_, T_predicted_, 10.0);
  EXPECT_TRUE(any_like(starts, T_previous_ * moved(0.5)));
  EXPECT_TRUE(any_like(starts, T_previous_ * moved(2.0)));
}

TEST_F(StartingMotions, TurnBothWaysAboutEveryAxis) {
  const auto starts = starting_motions(T_previous_, T_predicted_, 10.0);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double deg : {-8.0, -3.0, 3.0, 8.0}) {
      EXPECT_TRUE(
          any_like(starts, T_predicted_ * exp_se3(deg * M_PI / 180.0 * Vector6d::Unit(axis))));
    }
  }
}

TEST_F(StartingMotions, ShiftBySharesOfTheScenesDepth) {
  for (const double depth : {2.0, 40.0}) {
    const auto starts = starting_motions(T_previous_, T_predicted_, depth);
    for (int axis = 3; axis < 6; ++axis) {
      for (const double share : {-0.25, 0.05}) {
        EXPECT_TRUE(any_like(starts, T_predicted_ * exp_se3(share * depth * Vector6d::Unit(axis))));
      }
    }
  }
}

}  // namespace
}  // namespace sparsight
