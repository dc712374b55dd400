#include "drivers/datasets/rings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace sparsight {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

// A return whose intensity says which laser measured it.
LidarReturn return_at(double azimuth, double elevation, double range, int laser) {
  const double a = azimuth * kRadiansPerDegree;
  const double e = elevation * kRadiansPerDegree;
  LidarReturn point;
  point.p_lidar =
      (range * Eigen::Vector3d(std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)))
          .cast<float>();
  point.intensity = static_cast<float>(laser);
  return point;
}

// A scanner in a place whose walls are near and far by turns.
struct Scanner {
  int lasers = 16;
  double top_elevation = 2.0;
  double spacing = 0.4;
  double start_azimuth = 0.0;  // where storage starts; counter-clockwise from straight ahead
  double extent = 360.0;       // how far it runs from there
  double step = 1.0;
  int direction = 1;

  double elevation(int laser) const { return top_elevation - spacing * laser; }
  LidarReturn at(int laser, double turned) const {
    const double azimuth = start_azimuth + direction * turned;
    const double range = 15.0 + 5.0 * std::sin(3.0 * azimuth * kRadiansPerDegree);
    return return_at(azimuth, elevation(laser), range, laser);
  }
  std::vector<LidarReturn> ring_after_ring() const {
    std::vector<LidarReturn> returns;
    for (int laser = 0; laser < lasers; ++laser) {
      for (double turned = 0.5 * step; turned < extent; turned += step) {
        returns.push_back(at(laser, turned));
      }
    }
    return returns;
  }
  std::vector<LidarReturn> firing_after_firing() const {
    std::vector<LidarReturn> returns;
    for (double turned = 0.5 * step; turned < extent; turned += step) {
      // Lasers fire from the two halves by turns, as the VLP-16's do.
      for (int k = 0; k < lasers; ++k) {
        const int laser = (k % 2) * (lasers / 2) + k / 2;
        returns.push_back(at(laser, turned + 0.05 * step * k / lasers));
      }
    }
    return returns;
  }
};

bool ring_is_laser(const std::vector<LidarReturn>& returns) {
  return std::all_of(returns.begin(), returns.end(), [](const LidarReturn& point) {
    return static_cast<float>(point.ring) == point.intensity;
  });
}

double azimuth_of(const LidarReturn& point) {
  return std::atan2(point.p_lidar.y(), point.p_lidar.x()) / kRadiansPerDegree;
}

std::set<float> lasers_in(const std::vector<LidarReturn>& returns) {
  std::set<float> lasers;
  for (const LidarReturn& point : returns) lasers.insert(point.intensity);
  return lasers;
}

TEST(Rings, StartOverStraightAheadAsInKitti) {
  auto returns = Scanner{.lasers = 64}.ring_after_ring();
  EXPECT_EQ(assign_rings(returns), 64U);
  EXPECT_TRUE(ring_is_laser(returns));
}

TEST(Rings, StartOverAtTheBack) {
  auto returns = Scanner{.start_azimuth = -180.0}.ring_after_ring();
  EXPECT_EQ(assign_rings(returns), 16U);
  EXPECT_TRUE(ring_is_laser(returns));
}

TEST(Rings, StartOverWhereTheTurnBegan) {
  auto returns = Scanner{.start_azimuth = 73.0, .direction = -1}.ring_after_ring();
  EXPECT_EQ(assign_rings(returns), 16U);
  EXPECT_TRUE(ring_is_laser(returns));
}

TEST(Rings, StartOverAtTheEdgeOfACrop) {
  for (const int direction : {1, -1}) {
    auto returns =
        Scanner{.start_azimuth = -48.0 * direction, .extent = 96.0, .direction = direction}
            .ring_after_ring();
    EXPECT_EQ(assign_rings(returns), 16U);
    EXPECT_TRUE(ring_is_laser(returns));
  }
}

TEST(Rings, StartStraightAheadInsideACrop) {
  // The crop of a scan stored from straight ahead: each ring's storage jumps over the empty sector.
  auto returns = Scanner{.lasers = 64}.ring_after_ring();
  std::erase_if(returns, [](const LidarReturn& p) { return std::abs(azimuth_of(p)) > 48.0; });
  EXPECT_EQ(assign_rings(returns), 64U);
  EXPECT_TRUE(ring_is_laser(returns));
}

TEST(Rings, MayBeCroppedDifferently) {
  // Every fourth ring whole, the others cropped.
  auto returns = Scanner{.lasers = 64}.ring_after_ring();
  std::erase_if(returns, [](const LidarReturn& p) {
    return static_cast<int>(p.intensity) % 4 != 0 && std::abs(azimuth_of(p)) > 48.0;
  });
  EXPECT_EQ(assign_rings(returns), 64U);
  EXPECT_TRUE(ring_is_laser(returns));
}

TEST(Rings, OfAVlp16AreSixteen) {
  auto returns = Scanner{.top_elevation = 15.0, .spacing = 2.0, .step = 0.2}.ring_after_ring();
  EXPECT_EQ(assign_rings(returns), 16U);
  EXPECT_TRUE(ring_is_laser(returns));
}

TEST(Rings, AreTheRowsOfAnOrganisedDepthImage) {
  std::vector<LidarReturn> returns;
  for (int v = 0; v < 48; ++v) {
    for (int u = 0; u < 64; ++u) {
      if ((u * 7 + v * 13) % 11 == 0) continue;  // pixels without depth
      LidarReturn point;
      const double depth = u < 30 ? 1.0 : 2.5;
      point.p_lidar = Eigen::Vector3d(depth, -depth * (u - 31.5) / 52.5, -depth * (v - 23.5) / 52.5)
                          .cast<float>();
      point.intensity = static_cast<float>(v);
      returns.push_back(point);
    }
  }
  EXPECT_EQ(assign_rings(returns), 48U);
  EXPECT_TRUE(ring_is_laser(returns));
}

TEST(Rings, OfAScanInFiringOrderAreFoundByElevationAndSortedByAzimuth) {
  auto returns =
      Scanner{.top_elevation = 15.0, .spacing = 2.0, .start_azimuth = 100.0, .direction = -1}
          .firing_after_firing();
  EXPECT_EQ(assign_rings(returns), 16U);
  EXPECT_TRUE(ring_is_laser(returns));
  int backward_steps = 0;
  for (std::size_t i = 1; i < returns.size(); ++i) {
    ASSERT_GE(returns[i].ring, returns[i - 1].ring);
    if (returns[i].ring != returns[i - 1].ring) continue;
    const double step = azimuth_of(returns[i]) - azimuth_of(returns[i - 1]);
    EXPECT_LT(std::abs(std::remainder(step, 360.0)), 1.5);
    backward_steps += std::remainder(step, 360.0) < 0.0 ? 1 : 0;
  }
  EXPECT_EQ(backward_steps, 0);
}

TEST(Rings, OfAShuffledScanAreFoundByElevation) {
  auto returns = Scanner{.top_elevation = 15.0, .spacing = 2.0}.ring_after_ring();
  // 5 and the number of returns have no common factor but 5: every return moves, none is lost.
  std::vector<LidarReturn> shuffled;
  for (std::size_t i = 0; i < returns.size(); ++i) {
    shuffled.push_back(returns[i * 1237 % returns.size()]);
  }
  ASSERT_EQ(lasers_in(shuffled).size(), 16U);
  EXPECT_EQ(assign_rings(shuffled), 16U);
  EXPECT_TRUE(ring_is_laser(shuffled));
}

TEST(Rings, AreNotSplitByJitterAtTheSeam) {
  auto returns = Scanner{.lasers = 4}.ring_after_ring();
  // The second ring starts on the right side of straight ahead, falls back, and goes on.
  std::vector<LidarReturn> jittered(returns.begin(), returns.begin() + 360);
  jittered.push_back(return_at(0.1, 1.6, 10.0, 1));
  jittered.push_back(return_at(359.9, 1.6, 10.0, 1));
  jittered.insert(jittered.end(), returns.begin() + 360, returns.end());
  EXPECT_EQ(assign_rings(jittered), 4U);
  EXPECT_LE(
      std::count_if(jittered.begin(), jittered.end(),
                    [](const LidarReturn& p) { return static_cast<float>(p.ring) != p.intensity; }),
      1);
}

TEST(Rings, AreNotSplitByALastReturnPastTheSeam) {
  // Seen in drive 2011_09_26_0005, scan 42.
  auto returns = Scanner{.lasers = 8}.ring_after_ring();
  returns.push_back(return_at(0.001, Scanner{}.elevation(7), 10.0, 7));
  EXPECT_EQ(assign_rings(returns), 8U);
  EXPECT_TRUE(ring_is_laser(returns));
}

TEST(Rings, AreNotSplitByMotionCompensation) {
  // Compensating a sweep moves near returns back by a few degrees.
  auto returns = Scanner{.lasers = 8}.ring_after_ring();
  std::vector<LidarReturn> moved;
  for (const LidarReturn& point : returns) {
    const bool near = std::fmod(azimuth_of(point) + 380.0, 40.0) < 5.0;
    const double azimuth = azimuth_of(point) - (near ? 5.0 : 0.0);
    moved.push_back(return_at(azimuth, Scanner{}.elevation(static_cast<int>(point.intensity)), 10.0,
                              static_cast<int>(point.intensity)));
  }
  EXPECT_EQ(assign_rings(moved), 8U);
  EXPECT_GT(
      std::count_if(moved.begin(), moved.end(),
                    [](const LidarReturn& p) { return static_cast<float>(p.ring) == p.intensity; }),
      static_cast<std::ptrdiff_t>(moved.size() * 98 / 100));
}

TEST(Rings, OfNothingAreNone) {
  std::vector<LidarReturn> returns;
  EXPECT_EQ(assign_rings(returns), 0U);
}

TEST(Rings, OfASingleReturnAreOne) {
  std::vector<LidarReturn> returns{return_at(10.0, 1.0, 5.0, 0)};
  EXPECT_EQ(assign_rings(returns), 1U);
}

TEST(Rings, AreKeptEvenly) {
  auto returns = Scanner{.lasers = 64}.ring_after_ring();
  const std::size_t rings = assign_rings(returns);
  keep_rings(returns, rings, 8);
  EXPECT_THAT(lasers_in(returns), ::testing::ElementsAre(0, 8, 16, 24, 32, 40, 48, 56));
  EXPECT_EQ(returns.size(), 8U * 360U);
}

TEST(Rings, AreKeptWholeWhereThereAreNoMore) {
  auto returns = Scanner{.lasers = 16}.ring_after_ring();
  const std::size_t rings = assign_rings(returns);
  keep_rings(returns, rings, 64);
  EXPECT_EQ(lasers_in(returns).size(), 16U);
  keep_rings(returns, rings, 16);
  EXPECT_EQ(lasers_in(returns).size(), 16U);
}

RC_GTEST_PROP(Rings, KeepExactlyAsManyAsWanted, ()) {
  const auto count = *rc::gen::inRange<std::size_t>(1, 600);
  const auto wanted = *rc::gen::inRange<std::size_t>(1, 600);
  std::vector<LidarReturn> returns(count);
  for (std::size_t i = 0; i < count; ++i) returns[i].ring = static_cast<std::uint16_t>(i);
  keep_rings(returns, count, wanted);
  RC_ASSERT(returns.size() == std::min(count, wanted));
  // Evenly: gaps between kept rings differ by at most one.
  std::set<int> gaps;
  for (std::size_t i = 1; i < returns.size(); ++i)
    gaps.insert(returns[i].ring - returns[i - 1].ring);
  if (!gaps.empty()) RC_ASSERT(*gaps.rbegin() - *gaps.begin() <= 1);
}

RC_GTEST_PROP(Rings, AreTheLasersOfAnyScanStoredRingAfterRing, ()) {
  Scanner scanner;
  scanner.lasers = *rc::gen::inRange(3, 65);
  scanner.top_elevation = *rc::gen::inRange(0, 20);
  // No laser looks further down than 60 degrees; past the nadir it would look behind itself.
  const int widest =
      std::min(20, static_cast<int>(10.0 * (scanner.top_elevation + 60.0) / (scanner.lasers - 1)));
  scanner.spacing = *rc::gen::inRange(2, widest + 1) * 0.1;
  scanner.direction = *rc::gen::element(1, -1);
  // A whole turn or a crop that starts anywhere.
  scanner.start_azimuth = *rc::gen::inRange(-180, 180);
  scanner.extent = *rc::gen::element(360, 180, 96, 60);
  auto returns = scanner.ring_after_ring();
  RC_ASSERT(assign_rings(returns) == static_cast<std::size_t>(scanner.lasers));
  RC_ASSERT(ring_is_laser(returns));
}

RC_GTEST_PROP(Rings, LoseNoReturnAndStandInOrder, (std::vector<std::tuple<int, int, int>> points)) {
  std::vector<LidarReturn> returns;
  for (const auto& [x, y, z] : points) {
    LidarReturn point;
    point.p_lidar = Eigen::Vector3i(x, y, z).cast<float>();
    if (!point.p_lidar.isZero()) returns.push_back(point);
  }
  const std::size_t before = returns.size();
  const std::size_t rings = assign_rings(returns);
  RC_ASSERT(returns.size() == before);
  RC_ASSERT(std::is_sorted(returns.begin(), returns.end(),
                           [](const auto& a, const auto& b) { return a.ring < b.ring; }));
  RC_ASSERT(rings == (returns.empty() ? 0U : returns.back().ring + 1U));
}

}  // namespace
}  // namespace sparsight
