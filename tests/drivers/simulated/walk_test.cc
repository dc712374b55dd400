#include "drivers/simulated/walk.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drivers/simulated/corridor.h"

namespace sparsight::simulated {
namespace {

WalkPlan square_walk() {
  WalkPlan plan;
  plan.corners = {{0, 0}, {9, 0}, {9, 7}, {0, 7}};
  return plan;
}

TEST(Walk, BeginsAtRest) {
  const Walk walk(square_walk(), 3);
  const double moved =
      (walk.lidar_pose(0.6).translation() - walk.lidar_pose(0.0).translation()).norm();
  EXPECT_LT(moved, 0.02);
  EXPECT_NEAR(walk.lidar_pose(0.0).translation().z(), square_walk().height_m, 0.02);
}

TEST(Walk, GoesAtWalkingPace) {
  const Walk walk(square_walk(), 3);
  for (double t = 4.0; t < 30.0; t += 1.0) {
    const double speed =
        (walk.lidar_pose(t + 1.0).translation() - walk.lidar_pose(t).translation()).norm();
    EXPECT_GT(speed, 0.6) << t;
    EXPECT_LT(speed, 1.5) << t;
  }
}

// A jump of the acceleration would show as a step that does not shrink with the interval.
TEST(Walk, HasNoJumpInPoseVelocityOrAcceleration) {
  const Walk walk(square_walk(), 5);
  constexpr double kStep = 1e-3;
  const auto acceleration = [&](double t) -> Eigen::Vector3d {
    return (walk.lidar_pose(t + kStep).translation() - 2 * walk.lidar_pose(t).translation() +
            walk.lidar_pose(t - kStep).translation()) /
           (kStep * kStep);
  };
  const auto turning = [&](double t) {
    return Eigen::AngleAxisd(walk.lidar_pose(t - kStep).linear().transpose() *
                             walk.lidar_pose(t + kStep).linear())
               .angle() /
           (2 * kStep);
  };
  for (double t = 0.01; t < 40.0; t += 0.01) {
    EXPECT_LT(acceleration(t).norm(), 12.0) << t;
    EXPECT_LT((acceleration(t + 0.005) - acceleration(t)).norm(), 0.8) << t;
    EXPECT_LT(turning(t), 3.0) << t;
    EXPECT_LT(std::abs(turning(t + 0.005) - turning(t)), 0.12) << t;
  }
}

TEST(Walk, ReturnsToItsStartAfterALap) {
  WalkPlan plan = square_walk();
  plan.look_yaw_deg = 0.0;
  const Walk walk(plan, 7);
  const double lap_s = walk.lap_m() / plan.speed_m_s + plan.rest_s + 0.5 * plan.ramp_s;
  const Eigen::Isometry3d start = walk.lidar_pose(0.0);
  const Eigen::Isometry3d end = walk.lidar_pose(lap_s);
  EXPECT_LT((end.translation() - start.translation()).norm(), 0.4);
  EXPECT_LT(Eigen::AngleAxisd(start.linear().transpose() * end.linear()).angle(), 0.4);
}

TEST(Walk, OfTheCorridorIsALapOfSixtyMetresInAMinute) {
  const Scene scene = make_corridor(1);
  const Walk walk(scene.walk, 1);
  EXPECT_NEAR(walk.lap_m(), 60.0, 2.0);
  const Eigen::Vector3d gap =
      walk.lidar_pose(60.0).translation() - walk.lidar_pose(0.0).translation();
  EXPECT_LT(gap.norm(), 1.0);
}

}  // namespace
}  // namespace sparsight::simulated
