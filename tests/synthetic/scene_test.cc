#include "tests/synthetic/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sparsight::synthetic {
namespace {

double step_m(const Scene& scene, std::size_t frame) {
  return (scene.T_world_camera(scene.exposure_s(frame + 1)).translation() -
          scene.T_world_camera(scene.exposure_s(frame)).translation())
      .norm();
}

double turn_rate_deg_s(const Scene& scene, double seconds) {
  constexpr double kStep = 0.02;
  const Eigen::Matrix3d R = scene.T_world_camera(seconds).linear().transpose() *
                            scene.T_world_camera(seconds + kStep).linear();
  return Eigen::AngleAxisd(R).angle() / kStep * 180.0 / M_PI;
}

// Share of a coarse grid of rays that meets something that moves.
double moving_share(const Scene& scene, double seconds) {
  World still = scene.world;
  still.movers.clear();
  const auto with =
      render_depth(scene.world, scene.rig.camera, scene.T_world_camera(seconds), seconds);
  const auto without =
      render_depth(still, scene.rig.camera, scene.T_world_camera(seconds), seconds);
  std::size_t moving = 0;
  for (std::size_t i = 0; i < with.size(); ++i) moving += with[i] < without[i] ? 1U : 0U;
  return static_cast<double>(moving) / static_cast<double>(with.size());
}

TEST(Scene, UnknownNameIsRefusedWithTheNamesThereAre) {
  const auto scene = make_scene("moon");
  ASSERT_FALSE(scene);
  EXPECT_THAT(scene.error().message, ::testing::HasSubstr("corridor"));
}

TEST(Scene, SameSeedSameImageOtherSeedOtherWorld) {
  const auto image = [](std::uint64_t seed) {
    Scene scene = *make_scene("hall", seed);
    scene.resize(100, 75);
    return scene.image(2).pixels;
  };
  EXPECT_EQ(image(5), image(5));
  EXPECT_NE(image(5), image(6));
}

TEST(Scene, ResizingKeepsTheFieldOfView) {
  Scene scene = *make_scene("corridor");
  const CameraIntrinsics before = scene.rig.camera;
  scene.resize(400, 300);
  const CameraIntrinsics after = scene.rig.camera;
  EXPECT_NEAR((after.cx + 0.5) / after.fx, (before.cx + 0.5) / before.fx, 1e-12);
  EXPECT_NEAR((after.height - after.cy - 0.5) / after.fy,
              (before.height - before.cy - 0.5) / before.fy, 1e-12);
}

TEST(Scene, NoCameraWalksThroughAWall) {
  for (const std::string& name : scene_names()) {
    Scene scene = *make_scene(name);
    scene.resize(64, 48);
    for (std::size_t frame = 0; frame < 150; frame += 5) {
      const double t = scene.exposure_s(frame);
      const auto depth = render_depth(scene.world, scene.rig.camera, scene.T_world_camera(t), t);
      EXPECT_GT(*std::min_element(depth.begin(), depth.end()), 0.25) << name << " " << frame;
    }
  }
}

TEST(Scene, TheStreetIsDrivenAtTwelveDecimetresAFrame) {
  const Scene scene = *make_scene("street");
  for (std::size_t frame = 0; frame < 150; ++frame) {
    EXPECT_NEAR(step_m(scene, frame), 1.2, 0.15);
  }
}

TEST(Scene, TheHighwayIsAtSpeedFromTheFirstFrame) {
  const Scene scene = *make_scene("highway");
  for (std::size_t frame = 0; frame < 150; ++frame) {
    EXPECT_GT(step_m(scene, frame), 2.6);
    EXPECT_LT(step_m(scene, frame), 3.1);
  }
}

TEST(Scene, TheCarStandsFourSecondsAtTheLightsWhileAThirdOfThePictureMoves) {
  Scene scene = *make_scene("lights");
  EXPECT_GT(step_m(scene, 0), 0.8);
  int standing = 0;
  for (std::size_t frame = 0; frame < 180; ++frame) standing += step_m(scene, frame) < 0.03 ? 1 : 0;
  EXPECT_GE(standing, 40);
  EXPECT_GT(step_m(scene, 150), 0.8);
  scene.resize(120, 36);
  double largest = 0.0;
  for (double t = 5.5; t < 9.7; t += 0.1) largest = std::max(largest, moving_share(scene, t));
  EXPECT_GT(largest, 0.30);
  EXPECT_LT(largest, 0.75);
}

TEST(Scene, TheHandHeldHeadTurnsAsQuicklyAsPeopleDo) {
  for (const char* name : {"corridor", "hall"}) {
    const Scene scene = *make_scene(name);
    double fastest = 0.0;
    for (double t = 1.0; t < 16.0; t += 0.05) {
      fastest = std::max(fastest, turn_rate_deg_s(scene, t));
    }
    EXPECT_GT(fastest, 60.0) << name;
    EXPECT_LT(fastest, 140.0) << name;
  }
}

TEST(Scene, ExposureDriftsAndJumps) {
  const Scene scene = *make_scene("exposure");
  ASSERT_TRUE(scene.imager.brightness);
  double largest_jump = 0.0;
  double largest = 0.0;
  double smallest = 9.0;
  for (std::size_t frame = 0; frame < 149; ++frame) {
    const double now = scene.imager.brightness(scene.exposure_s(frame)).x();
    const double next = scene.imager.brightness(scene.exposure_s(frame + 1)).x();
    largest_jump = std::max(largest_jump, std::abs(next - now));
    largest = std::max(largest, now);
    smallest = std::min(smallest, now);
  }
  EXPECT_GT(largest_jump, 0.2);
  EXPECT_GT(largest / smallest, 1.6);
}

}  // namespace
}  // namespace sparsight::synthetic
