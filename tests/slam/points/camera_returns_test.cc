#include "slam/points/camera_returns.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "tests/slam/random_values.h"
#include "tests/slam/sine_room.h"

namespace sparsight {
namespace {

// LiDAR axes (forward, left, up) to camera axes, with a lever arm.
Eigen::Isometry3d mounted() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  T.translation() = Eigen::Vector3d(0.1, -0.2, -0.3);
  return T;
}

Sweep sweep_of(const std::vector<Eigen::Vector3d>& points_lidar) {
  Sweep sweep{.motion_compensated = true};
  for (const Eigen::Vector3d& p : points_lidar) {
    sweep.returns.push_back({.p_lidar = p.cast<float>(),
                             .intensity = 0.25F,
                             .ring = static_cast<std::uint16_t>(sweep.returns.size())});
  }
  return sweep;
}

TEST(ReturnsInImage, MovesReturnsIntoTheCameraAndKeepsTheirOrder) {
  // Straight ahead; behind; far to the left; a little up and to the right.
  const Sweep sweep = sweep_of({{10, 0, 0}, {-10, 0, 0}, {1, 20, 0}, {10, -2, 1}});
  const SineRoom room;
  const auto returns =
      returns_in_image(sweep, room.camera(), mounted(), constant_motion(Vector6d::Zero()));
  ASSERT_EQ(returns.size(), 2U);
  EXPECT_LT((returns[0].p_camera - Eigen::Vector3f(0.1F, -0.2F, 9.7F)).norm(), 1e-6F);
  EXPECT_LT((returns[1].p_camera - Eigen::Vector3f(2.1F, -1.2F, 9.7F)).norm(), 1e-6F);
  EXPECT_EQ(returns[0].ring, 0);
  EXPECT_EQ(returns[1].ring, 3);
  EXPECT_EQ(returns[0].intensity, 0.25F);
  const CameraIntrinsics& c = room.intrinsics;
  EXPECT_NEAR(returns[1].pixel.x(), c.fx * 2.1 / 9.7 + c.cx, 1e-4);
  EXPECT_NEAR(returns[1].pixel.y(), c.fy * -1.2 / 9.7 + c.cy, 1e-4);
}

TEST(ReturnsInImage, DropsWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const Sweep sweep = sweep_of({{nan, 0, 0}, {10, nan, 0}, {10, 0, nan}, {infinity, 0, 0}});
  EXPECT_TRUE(
      returns_in_image(sweep, SineRoom().camera(), mounted(), constant_motion(Vector6d::Zero()))
          .empty());
  EXPECT_TRUE(
      returns_in_image({}, SineRoom().camera(), mounted(), constant_motion(Vector6d::Zero()))
          .empty());
}

TEST(ReturnsInImage, LeavesACompensatedSweepWhereItIs) {
  Sweep sweep = sweep_of({{10, 0, 0}});
  sweep.returns[0].from_exposure_ns = 50'000'000;
  const Vector6d twist = Vector6d::Constant(0.5);
  const auto returns =
      returns_in_image(sweep, SineRoom().camera(), mounted(), constant_motion(twist));
  ASSERT_EQ(returns.size(), 1U);
  EXPECT_LT((returns[0].p_camera - Eigen::Vector3f(0.1F, -0.2F, 9.7F)).norm(), 1e-6F);
}

// Each firing sees the wall from where the LiDAR then is; afterwards the wall must be flat again.
// The motion is tabulated in 512 slots: what is left is the motion within half of one.
RC_GTEST_PROP(ReturnsInImage, MakesAWallFlatThatWasScannedInConstantMotion, ()) {
  Vector6d twist;  // up to a quick turn of the head and 30 m/s
  twist << any_vector(2.0), any_vector(30.0);
  const double depth = any_between(3.0, 40.0);
  constexpr double kPeriod = 0.1;
  Sweep sweep;
  std::vector<Eigen::Vector3d> wall;
  for (int i = 0; i < 400; ++i) {
    const double seconds = kPeriod * (i / 400.0 - 0.5);
    const double side = 0.5 * depth * (i / 200.0 - 1.0);
    wall.emplace_back(side, 0.2 * depth * std::sin(i), depth);
    const Eigen::Vector3d p_lidar =
        mounted().inverse() * (exp_se3(twist * seconds).inverse() * wall.back());
    sweep.returns.push_back({.p_lidar = p_lidar.cast<float>(),
                             .from_exposure_ns = static_cast<std::int32_t>(1e9 * seconds),
                             .ring = static_cast<std::uint16_t>(i)});
  }
  const auto returns =
      returns_in_image(sweep, SineRoom().camera(), mounted(), constant_motion(twist));
  RC_ASSERT(returns.size() > 200U);
  const double half_slot = kPeriod / 512.0 / 2.0;
  for (const CameraReturn& r : returns) {
    const Eigen::Vector3d& truth = wall[r.ring];
    const double bound =
        1.05 * half_slot * (twist.tail<3>().norm() + twist.head<3>().norm() * truth.norm()) + 1e-4;
    RC_ASSERT((r.p_camera.cast<double>() - truth).norm() < bound);
  }
}

}  // namespace
}  // namespace sparsight
