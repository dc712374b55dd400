#include "slam/lidar/rough_points.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/slam/lidar/scanned_room.h"
#include "tests/slam/random_values.h"

namespace sparsight {
namespace {

// The weights of a sweep's own returns, seen by a camera that stands somewhere beside the LiDAR.
std::vector<float> weights(const Sweep& sweep, const SweepSurface& surface,
                           const Eigen::Isometry3d& T_camera_lidar) {
  std::vector<SelectedPoint> points;
  for (const LidarReturn& r : sweep.returns) {
    points.push_back({.p_camera = T_camera_lidar.cast<float>() * r.p_lidar, .pixel = {0.0F, 0.0F}});
  }
  weigh_down_rough(points, surface, T_camera_lidar);
  std::vector<float> result;
  for (const SelectedPoint& point : points) result.push_back(point.weight);
  return result;
}

RC_GTEST_PROP(RoughPoints, AreNotThoseOfWalls, ()) {
  ScannedRoom room;
  room.rings = *rc::gen::element(8, 16, 64);
  room.ring_deg = room.rings == 64 ? 0.4 : room.rings == 8 ? 3.4 : 2.0;
  const Eigen::Isometry3d T = exp_se3(any_increment(0.1, 1.0));
  const auto weight = weights(room.sweep(T, 1), room.surface(T), any_pose());
  // Where walls meet, and at the ends of the rings, planes are few.
  const auto kept = std::count(weight.begin(), weight.end(), 1.0F);
  RC_ASSERT(kept > 0.5 * static_cast<double>(weight.size()));
}

// A post of 6 cm before the wall at x = 9, as wide as three returns.
TEST(RoughPoints, AreThoseOfAPost) {
  ScannedRoom room;
  room.column_deg = 0.4;
  const Obstacle post{.lowest = {4.0, 0.47, -1.1}, .highest = {4.06, 0.53, 1.4}};
  const Sweep sweep = room.sweep(kHere, 1, post);
  const auto weight = weights(sweep, room.surface(kHere, post), kHere);
  int of_post = 0;
  for (std::size_t i = 0; i < weight.size(); ++i) {
    const Eigen::Vector3f& p = sweep.returns[i].p_lidar;
    if (std::abs(p.x() - 4.0F) > 0.1F || std::abs(p.y() - 0.5F) > 0.1F) continue;
    if (std::abs(p.z()) > 0.8F) continue;
    ++of_post;
    EXPECT_LT(weight[i], 0.5F) << p.transpose();
  }
  EXPECT_GT(of_post, 10);
}

TEST(RoughPoints, AreAllWhereNoSweepIs) {
  const Sweep sweep = ScannedRoom().sweep(kHere, 1);
  for (const float weight : weights(sweep, SweepSurface(), kHere)) ASSERT_EQ(weight, 0.2F);
}

TEST(RoughPoints, LoseAPartOfWhatWeightTheyHad) {
  std::vector<SelectedPoint> points{
      {.p_camera = {0.0F, 0.0F, 5.0F}, .pixel = {0.0F, 0.0F}, .weight = 0.1F}};
  weigh_down_rough(points, SweepSurface(), kHere);
  EXPECT_FLOAT_EQ(points.front().weight, 0.02F);
}

TEST(RoughPoints, CountFullyInTrackingWhateverElseTheirWeightIs) {
  std::vector<SelectedPoint> points(3, {.p_camera = {0.0F, 0.0F, 5.0F}, .pixel = {0.0F, 0.0F}});
  weigh_down_rough(points, SweepSurface(), kHere);
  points[1].rough = false;
  points[2].weight *= 0.1F;  // a stranger
  std::vector<PatchSet> patches(2);
  for (PatchSet& level : patches) {
    for (const SelectedPoint& point : points) {
      level.weight.insert(level.weight.end(), kPatternSize, point.weight);
    }
    level.weight.resize(level.weight.size() + 5, 0.0F);  // padding
  }
  count_rough_fully(points, patches);
  for (const PatchSet& level : patches) {
    EXPECT_FLOAT_EQ(level.weight[0], 1.0F);
    EXPECT_FLOAT_EQ(level.weight[kPatternSize], 0.2F);
    EXPECT_FLOAT_EQ(level.weight[2 * kPatternSize], 0.1F);
    EXPECT_FLOAT_EQ(level.weight[3 * kPatternSize - 1], 0.1F);
    EXPECT_EQ(level.weight.back(), 0.0F);
  }
}

}  // namespace
}  // namespace sparsight
