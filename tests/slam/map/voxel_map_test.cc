#include "slam/map/voxel_map.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <tuple>

namespace sparsight {
namespace {

using Cloud = std::vector<CloudPoint>;

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}
const Eigen::Isometry3d kOrigin = Eigen::Isometry3d::Identity();

CloudPoint grey_point(float x, float y, float z, std::uint8_t grey = 0) {
  return {.p_camera = {x, y, z}, .intensity = 0.5F, .rgb = {grey, grey, grey}};
}

std::tuple<int, int, int> voxel_of(const Eigen::Vector3f& p, double voxel_m) {
  const auto index = [&](float coordinate) {
    return static_cast<int>(std::floor(static_cast<double>(coordinate) / voxel_m));
  };
  return {index(p.x()), index(p.y()), index(p.z())};
}

TEST(VoxelMap, PlacesCloudsInTheWorld) {
  Eigen::Isometry3d T_world_camera = at(10, 20, 30);
  T_world_camera.rotate(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()));
  VoxelMap map({});
  map.add(T_world_camera, Cloud{grey_point(1, 0, 2)});
  ASSERT_EQ(map.points().size(), 1U);
  // A quarter turn to the right: forward becomes x, right becomes -z.
  EXPECT_TRUE(map.points()[0].p_world.isApprox(Eigen::Vector3f(12, 20, 29), 1e-6F));
  EXPECT_EQ(map.points()[0].intensity, 0.5F);
}

TEST(VoxelMap, OneVoxelKeepsTheReturnSeenFromNearest) {
  VoxelMap map({.voxel_m = 1.0});
  map.add(kOrigin, Cloud{grey_point(0.5F, 0.5F, 20.5F, 1)});
  map.add(at(0, 0, 15), Cloud{grey_point(0.5F, 0.5F, 5.4F, 2)});
  map.add(kOrigin, Cloud{grey_point(0.5F, 0.5F, 20.6F, 3)});
  ASSERT_EQ(map.points().size(), 1U);
  EXPECT_EQ(map.points()[0].rgb[0], 2);
  EXPECT_FLOAT_EQ(map.points()[0].p_world.z(), 20.4F);
}

TEST(VoxelMap, AColourGoesBeforeNearness) {
  CloudPoint near_but_hidden = grey_point(0.5F, 0.5F, 2.5F);
  near_but_hidden.colored = false;
  const CloudPoint far_and_seen = grey_point(0.5F, 0.5F, 12.5F, 90);
  for (const bool hidden_first : {true, false}) {
    VoxelMap map({.voxel_m = 1.0});
    if (hidden_first) map.add(at(0, 0, 10), Cloud{near_but_hidden});
    map.add(kOrigin, Cloud{far_and_seen});
    if (!hidden_first) map.add(at(0, 0, 10), Cloud{near_but_hidden});
    ASSERT_EQ(map.points().size(), 1U);
    EXPECT_EQ(map.points()[0].rgb[0], 90);
    EXPECT_TRUE(map.points()[0].colored);
  }
}

TEST(VoxelMap, VoxelsOnBothSidesOfZeroAreDifferent) {
  VoxelMap map({.voxel_m = 1.0});
  map.add(kOrigin, Cloud{grey_point(-0.4F, 0.2F, 1.5F), grey_point(0.4F, 0.2F, 1.5F)});
  EXPECT_EQ(map.points().size(), 2U);
}

TEST(VoxelMap, LeavesOutWhatIsFarOrNotANumber) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  VoxelMap map({.max_range_m = 60.0});
  map.add(kOrigin, Cloud{grey_point(0, 0, 61), grey_point(nan, 0, 1), grey_point(0, infinity, 1),
                         grey_point(0, 0, 59)});
  map.add(at(1e9, 0, 0), Cloud{grey_point(0, 0, 1)});
  EXPECT_EQ(map.points().size(), 1U);
}

TEST(VoxelMap, NeverHoldsMoreThanItsBoundAndCoarsensInstead) {
  VoxelMap map({.voxel_m = 0.1, .max_points = 1000});
  for (int i = 0; i < 30; ++i) {
    Cloud cloud;
    for (int j = 0; j < 400; ++j) {
      cloud.push_back(
          grey_point(0.1F * static_cast<float>(j % 20), 0.1F * static_cast<float>(j / 20), 5.0F));
    }
    map.add(at(5.0 * i, 0, 0), cloud);
    ASSERT_LE(map.points().size(), 1000U);
  }
  EXPECT_GT(map.voxel_m(), 0.15);
  EXPECT_GT(map.points().back().p_world.x(), 140.0F);
}

RC_GTEST_PROP(VoxelMap, EveryPlaceSeenIsKeptOnce, ()) {
  const auto numbers = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-3000, 3000));
  VoxelMap map({.voxel_m = 0.25, .max_range_m = 100.0});
  std::set<std::tuple<int, int, int>> seen;
  std::vector<CloudPoint> cloud;
  for (std::size_t i = 0; i + 2 < numbers.size(); ++i) {
    cloud.push_back(grey_point(0.01F * static_cast<float>(numbers[i]),
                               0.01F * static_cast<float>(numbers[i + 1]),
                               0.01F * static_cast<float>(numbers[i + 2])));
    seen.insert(voxel_of(cloud.back().p_camera, 0.25));
  }
  map.add(kOrigin, cloud);
  map.add(kOrigin, cloud);
  std::set<std::tuple<int, int, int>> kept;
  for (const MapPoint& point : map.points()) kept.insert(voxel_of(point.p_world, 0.25));
  RC_ASSERT(kept == seen);
  RC_ASSERT(map.points().size() == kept.size());
}

}  // namespace
}  // namespace sparsight
