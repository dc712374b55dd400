#include "slam/lidar/sweep_sample.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "tests/slam/lidar/scanned_room.h"

namespace sparsight {
namespace {

std::vector<Eigen::Vector3f> sampled(const Sweep& sweep, const Vector6d& twist = Vector6d::Zero()) {
  std::vector<Eigen::Vector3f> result;
  sample_sweep(sweep, twist, ScannedRoom().surface(kHere), kHere, result);
  return result;
}

TEST(SweepSample, HasAsManyOfEveryDirectionThatPlanesFace) {
  const ScannedRoom room;
  const SweepSurface surface = room.surface(kHere);
  std::vector<Eigen::Vector3f> taken;
  sample_sweep(room.sweep(kHere, 3), Vector6d::Zero(), surface, kHere, taken);
  std::array<int, 3> facing{};
  for (const Eigen::Vector3f& p : taken) {
    Eigen::Index axis = 0;
    surface.at(p)->normal.cwiseAbs().maxCoeff(&axis);
    ++facing[static_cast<std::size_t>(axis)];
  }
  EXPECT_LE(taken.size(), kMostSampled);
  for (const int of_axis : facing) EXPECT_GE(of_axis, static_cast<int>(kMostSampled) / 5);
}

// The order of a VLP-16's firings: all rings in turn. Steps of any even number would see half.
TEST(SweepSample, TakesEveryRingInWhateverOrderTheyCome) {
  const ScannedRoom room;
  const Sweep by_ring = room.sweep(kHere, 3);
  Sweep by_firing{.motion_compensated = true};
  const std::size_t columns = by_ring.returns.size() / 16;
  for (std::size_t column = 0; column < columns; ++column) {
    for (std::size_t ring = 0; ring < 16; ++ring) {
      by_firing.returns.push_back(by_ring.returns[ring * columns + column]);
    }
  }
  std::array<int, 16> of_ring{};
  for (const Eigen::Vector3f& p : sampled(by_firing)) {
    const double elevation = std::atan2(p.z(), std::hypot(p.x(), p.y())) * 180.0 / M_PI;
    ++of_ring[static_cast<std::size_t>(std::lround(elevation / 2.0 + 7.5))];
  }
  for (const int returns : of_ring) EXPECT_GE(returns, 8);
}

TEST(SweepSample, MovesReturnsToTheExposure) {
  Sweep sweep = ScannedRoom().sweep(kHere, 1);
  sweep.motion_compensated = false;
  for (LidarReturn& r : sweep.returns) {
    r.from_exposure_ns = 50'000'000;
    r.p_lidar.x() -= 0.5F;
  }
  Vector6d twist = Vector6d::Zero();
  twist(3) = 10.0;
  for (const Eigen::Vector3f& p : sampled(sweep, twist)) {
    EXPECT_LT(ScannedRoom().distance_to_wall(p.cast<double>()), 0.06);
  }
}

TEST(SweepSample, OfNothingIsNothing) {
  EXPECT_TRUE(sampled({}).empty());
  Sweep broken = ScannedRoom().sweep(kHere, 1);
  for (LidarReturn& r : broken.returns) r.p_lidar.y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(sampled(broken).empty());
}

}  // namespace
}  // namespace sparsight
