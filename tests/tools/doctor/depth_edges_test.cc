#include "tools/doctor/depth_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace sparsight {
namespace {

constexpr double kStepRad = 0.2 * M_PI / 180.0;

// A ring of 301 returns to 30 degrees of either side of straight ahead.
Sweep ring_of(const std::function<double(double azimuth)>& range_at) {
  Sweep sweep;
  for (int i = -150; i <= 150; ++i) {
    const double azimuth = -i * kStepRad;  // clockwise, y points left
    const double range = range_at(azimuth);
    LidarReturn r;
    r.p_lidar = (range * Eigen::Vector3d(std::cos(azimuth), std::sin(azimuth), 0.0)).cast<float>();
    sweep.returns.push_back(r);
  }
  return sweep;
}

RigCalibration lidar_in_camera() {
  RigCalibration rig;
  rig.T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return rig;
}

TEST(DepthEdges, LieHalfWayBetweenTheFiringsAtTheNearSide) {
  // A post 2 m away before a wall, from 0 to 5 degrees left.
  const auto edges = depth_edges(
      ring_of([](double a) { return a > -0.5 * kStepRad && a < 25.5 * kStepRad ? 2.0 : 6.0; }),
      lidar_in_camera());
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_NEAR(edges[0].p_camera.norm(), 2.0, 1e-6);
  EXPECT_NEAR(std::atan2(-edges[0].p_camera.x(), edges[0].p_camera.z()), 25.5 * kStepRad, 1e-6);
  EXPECT_NEAR(std::atan2(-edges[1].p_camera.x(), edges[1].p_camera.z()), -0.5 * kStepRad, 1e-6);
  EXPECT_NEAR(edges[0].weight, std::sqrt(3.0), 1e-6) << "more than 3 m weigh no more";
}

TEST(DepthEdges, AWallAtAGrazingAngleHasNone) {
  const auto wall = ring_of([](double a) { return 1.0 / std::sin(a + 33.0 * M_PI / 180.0); });
  EXPECT_GT(wall.returns.back().p_lidar.norm() - wall.returns[299].p_lidar.norm(), 0.5F);
  EXPECT_TRUE(depth_edges(wall, lidar_in_camera()).empty());
}

TEST(DepthEdges, NeedNeighboursOfOneRingNearTheExposure) {
  const auto post = [](double a) { return a > 0.0 ? 2.0 : 6.0; };
  Sweep sweep = ring_of(post);
  EXPECT_EQ(depth_edges(sweep, lidar_in_camera()).size(), 1U);
  for (std::size_t i = 150; i < sweep.returns.size(); ++i) sweep.returns[i].ring = 1;
  EXPECT_TRUE(depth_edges(sweep, lidar_in_camera()).empty()) << "of two rings";
  sweep = ring_of(post);
  for (LidarReturn& r : sweep.returns) r.from_exposure_ns = 40'000'000;
  EXPECT_TRUE(depth_edges(sweep, lidar_in_camera()).empty()) << "the rig may have moved";
  sweep = ring_of(post);
  sweep.returns.erase(sweep.returns.begin() + 140, sweep.returns.begin() + 160);
  EXPECT_TRUE(depth_edges(sweep, lidar_in_camera()).empty()) << "what is between is not known";
}

}  // namespace
}  // namespace sparsight
