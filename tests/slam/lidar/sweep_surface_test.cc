#include "slam/lidar/sweep_surface.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "tests/slam/lidar/scanned_room.h"
#include "tests/slam/random_values.h"

namespace sparsight {
namespace {

SweepSurface surface_of_points(const std::vector<SweepPoint>& points) {
  return SweepSurface(points);
}

TEST(SweepSurface, OfNothingIsEmpty) {
  EXPECT_TRUE(SweepSurface().empty());
  EXPECT_TRUE(surface_of_points({}).empty());
  EXPECT_EQ(SweepSurface().at({1.0F, 0.0F, 0.0F}), nullptr);
}

TEST(SweepSurface, HasTheWallWhereTheScannerSeesIt) {
  const ScannedRoom room;
  const SweepSurface surface = room.surface(kHere);
  const SweepSurface::Plane* ahead = surface.at({9.0F, 0.5F, 0.3F});
  ASSERT_NE(ahead, nullptr);
  EXPECT_GT(std::abs(ahead->normal.x()), 0.99F);
  EXPECT_NEAR(ahead->centre.x(), 9.0F, 0.02F);
  EXPECT_LT(ahead->thickness_m, 0.02F);
  const SweepSurface::Plane* floor = surface.at({6.0F, 0.5F, -1.1F});
  ASSERT_NE(floor, nullptr);
  EXPECT_GT(std::abs(floor->normal.z()), 0.98F);
}

TEST(SweepSurface, EndsWhereTheRingsEnd) {
  const SweepSurface surface = ScannedRoom().surface(kHere);
  EXPECT_EQ(surface.at({0.1F, 0.0F, 1.4F}), nullptr) << "overhead";
  EXPECT_EQ(surface.at({0.1F, 0.0F, -1.1F}), nullptr) << "underfoot";
}

// Of a bin at an edge the plane is that of one side, and what lies on the other is not on it.
RC_GTEST_PROP(SweepSurface, LiesOnTheWallsFromWhereverTheyAreSeen, ()) {
  ScannedRoom room;
  room.rings = *rc::gen::element(8, 16, 64);
  room.ring_deg = room.rings == 64 ? 0.4 : room.rings == 8 ? 3.4 : 2.0;
  const Eigen::Isometry3d T = exp_se3(any_increment(0.1, 1.0));
  const SweepSurface surface = room.surface(T);
  int with_plane = 0;
  int on_plane = 0;
  int returns = 0;
  for (const LidarReturn& r : room.sweep(T, 2).returns) {
    ++returns;
    const SweepSurface::Plane* plane = surface.at(r.p_lidar);
    if (plane == nullptr) continue;
    ++with_plane;
    RC_ASSERT(std::abs(plane->normal.norm() - 1.0F) < 1e-4F);
    const float distance = std::abs(plane->normal.dot(r.p_lidar - plane->centre));
    if (distance < 3.0F * plane->thickness_m + 0.03F) ++on_plane;
  }
  RC_ASSERT(with_plane > 0.6 * returns);
  RC_ASSERT(on_plane > 0.9 * with_plane);
}

TEST(SweepSurface, IsNoneInATree) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> anywhere(-2.0F, 2.0F);
  std::vector<SweepPoint> leaves;
  for (int i = 0; i < 20000; ++i) {
    const Eigen::Vector3f p(10.0F + anywhere(random), anywhere(random), anywhere(random));
    leaves.push_back({.p_lidar = p, .ring = static_cast<std::uint16_t>((p.z() + 2.0F) / 0.35F)});
  }
  const SweepSurface surface = surface_of_points(leaves);
  EXPECT_FALSE(surface.empty());
  EXPECT_EQ(surface.at({10.0F, 0.1F, 0.1F}), nullptr);
}

TEST(SweepSurface, LeavesOutWhatIsNotANumber) {
  const ScannedRoom room;
  Sweep sweep = room.sweep(kHere, 1);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < sweep.returns.size(); i += 3) sweep.returns[i].p_lidar.x() = nan;
  const SweepSurface surface = surface_of(sweep, kHere, constant_motion(Vector6d::Zero()));
  ASSERT_NE(surface.at({9.0F, 0.5F, 0.3F}), nullptr);
  EXPECT_TRUE(surface.at({9.0F, 0.5F, 0.3F})->normal.allFinite());
}

TEST(SweepSurface, MovesReturnsToTheExposure) {
  const ScannedRoom room;
  Sweep sweep = room.sweep(kHere, 1);
  sweep.motion_compensated = false;
  // Half a turn of the scanner before the exposure, driving at 20 m/s: a metre behind.
  for (LidarReturn& r : sweep.returns) {
    r.from_exposure_ns = -50'000'000;
    r.p_lidar.x() += 1.0F;
  }
  Vector6d twist = Vector6d::Zero();
  twist(3) = 20.0;
  const SweepSurface surface = surface_of(sweep, kHere, constant_motion(twist));
  ASSERT_NE(surface.at({9.0F, 0.5F, 0.3F}), nullptr);
  EXPECT_NEAR(surface.at({9.0F, 0.5F, 0.3F})->centre.x(), 9.0F, 0.03F);
}

}  // namespace
}  // namespace sparsight
