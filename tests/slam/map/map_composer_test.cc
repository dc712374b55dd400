#include "slam/map/map_composer.h"

#include <gtest/gtest.h>

namespace sparsight {
namespace {

const CameraIntrinsics kCamera{640, 480, 500.0, 500.0, 319.5, 239.5};
constexpr std::uint8_t kWall = 40;
constexpr std::uint8_t kPost = 200;

CloudPoint point(float x, float y, float z, std::uint8_t grey) {
  return {.p_camera = {x, y, z}, .rgb = {grey, grey, grey}};
}

// A camera at x, looking along z at a wall 10 m ahead; 4 m ahead a post from x = 0 to .2, which
// it sees through whatever its LiDAR measured.
PosedCloud looking_from(float x, const std::vector<Eigen::Vector3f>& measured) {
  PosedCloud keyframe{.camera = kCamera};
  keyframe.T_world_camera.translation().x() = x;
  for (const Eigen::Vector3f& p : measured) {
    // The colour of the first thing along the pixel's ray, as the image has it.
    const float at_post = x + (p.x() - x) * 4.0F / p.z();
    const bool post = at_post >= 0.0F && at_post <= 0.2F;
    keyframe.cloud_camera.push_back(point(p.x() - x, p.y(), p.z(), post ? kPost : kWall));
  }
  return keyframe;
}

std::vector<Eigen::Vector3f> wall(float from, float to) {
  std::vector<Eigen::Vector3f> points;
  for (float x = from; x <= to; x += 0.05F) points.emplace_back(x, 0.3F, 10.0F);
  return points;
}
std::vector<Eigen::Vector3f> post() {
  std::vector<Eigen::Vector3f> points;
  for (float x = 0.0F; x <= 0.2F; x += 0.02F) points.emplace_back(x, 0.12F, 4.0F);
  return points;
}

struct WallColors {
  std::size_t own = 0;
  std::size_t of_post = 0;
  std::size_t none = 0;
};

WallColors colors_of(const VoxelMap& map) {
  WallColors colors;
  for (const MapPoint& p : map.points()) {
    if (p.p_world.z() < 5.0F) continue;
    if (!p.colored) {
      ++colors.none;
    } else {
      ++(p.rgb[0] == kPost ? colors.of_post : colors.own);
    }
  }
  return colors;
}

VoxelMap composed(const std::vector<PosedCloud>& keyframes) {
  VoxelMap map({.voxel_m = 0.05});
  MapComposer composer(map);
  for (const PosedCloud& keyframe : keyframes) composer.add(keyframe);
  composer.finish();
  return map;
}

// The beams of this scan miss the post that its image shows; those of the next hit it.
TEST(MapComposer, WhatAKeyframesNeighbourSawInFrontTakesAwayTheColour) {
  const WallColors alone = colors_of(composed({looking_from(0.1F, wall(-2.0F, 2.0F))}));
  EXPECT_GT(alone.of_post, 5);
  const WallColors both =
      colors_of(composed({looking_from(0.1F, wall(-2.0F, 2.0F)), looking_from(0.11F, post())}));
  EXPECT_EQ(both.of_post, 0);
  EXPECT_GT(both.none, 5);
  EXPECT_LT(both.none, 25);  // 20 cells of wall lie behind 20 cm of post, and a margin
  EXPECT_EQ(both.own + both.none, alone.own + alone.of_post) << "points went, not only colours";
}

TEST(MapComposer, APointThatOneKeyframeCannotSeeTakesTheColourOfAnotherThatDoes) {
  const WallColors colors =
      colors_of(composed({looking_from(0.1F, wall(-2.0F, 2.0F)), looking_from(0.11F, post()),
                          looking_from(1.5F, wall(-2.0F, 2.0F))}));
  EXPECT_EQ(colors.of_post, 0);
  EXPECT_EQ(colors.none, 0);
  EXPECT_GT(colors.own, 70);
}

TEST(MapComposer, EveryKeyframeComesIntoTheMapOnceHoweverMany) {
  for (const std::size_t count : {1U, 3U, 4U, 5U, 20U}) {
    std::vector<PosedCloud> keyframes;
    for (std::size_t i = 0; i < count; ++i) {
      keyframes.push_back({.camera = kCamera, .cloud_camera = {point(0, 0, 5, 7)}});
      keyframes.back().T_world_camera.translation().z() = static_cast<double>(i);
    }
    const VoxelMap map = composed(keyframes);
    EXPECT_EQ(map.points().size(), count);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_FLOAT_EQ(map.points()[i].p_world.z(), 5.0F + static_cast<float>(i));
    }
  }
}

TEST(MapComposer, PointsThatFallOutOfTheImageAreKept) {
  VoxelMap map({});
  MapComposer composer(map);
  composer.add({.camera = kCamera, .cloud_camera = {point(9, 0, 1, 3), point(0, 0, -1, 3)}});
  composer.finish();
  EXPECT_EQ(map.points().size(), 2U);
}

}  // namespace
}  // namespace sparsight
