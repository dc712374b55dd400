#include "slam/calibration/self_calibration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/slam/sine_room.h"

namespace sparsight {
namespace {

constexpr SelfCalibrationConfig kOpenMinded{
    .enabled = true, .focal_sigma = 0.02, .k1_sigma = 0.05, .believed_share = 0.2};

// A walk that also turns: a turn is what shows the focal length.
Eigen::Isometry3d step_of_walk(int i) {
  return pose(0.02 * std::sin(i), 0.05 * i, 0.02 * std::cos(i), 0.04 * i, 0.02 * std::sin(2.0 * i),
              0.12 * i);
}

// Shows pairs of images taken by the `real` camera to a calibration that was given another. Depth
// is known as a LiDAR knows it, whatever the camera.
void walk(const SineRoom& real, int steps, SelfCalibration& calibration) {
  AlignmentWorkspace workspace;
  const PhotometryConfig photometry{.affine_brightness = true};
  for (int i = 0; i < steps; ++i) {
    const Eigen::Isometry3d T_world_host = step_of_walk(i);
    const Eigen::Isometry3d T_world_target = step_of_walk(i + 1);
    Keyframe host = real.keyframe(0, T_world_host);
    const GreyImage target = real.image(T_world_target);
    host.patches = {make_patches(host.pyramid, 0, calibration.camera(), host.points, 0.0)};
    const Alignment start{.T_camera_keyframe = T_world_target.inverse() * T_world_host};
    const Alignment at = align(host.patches[0], target, calibration.camera(),
                               host.mean_inverse_depth, start, {}, photometry, workspace);
    assess(host.patches[0], target, calibration.camera(), at, photometry, workspace);
    calibration.observe(host, at, workspace.current, photometry);
    calibration.update();
  }
}

TEST(SelfCalibration, FindsTheDistortionThatTheGivenCameraLacks) {
  SineRoom real;
  real.intrinsics.k1 = 0.03;
  CameraIntrinsics given = real.intrinsics;
  given.k1 = 0.0;
  SelfCalibration calibration(given, kOpenMinded);
  walk(real, 20, calibration);
  EXPECT_NEAR(calibration.camera().intrinsics().k1, 0.03, 0.006);
  EXPECT_NEAR(calibration.camera().intrinsics().fx / real.intrinsics.fx, 1.0, 0.003);
}

TEST(SelfCalibration, FindsTheFocalLengthInTurns) {
  const SineRoom real;
  CameraIntrinsics given = real.intrinsics;
  given.fx *= 1.01;
  given.fy *= 1.01;
  SelfCalibration calibration(given, kOpenMinded);
  walk(real, 20, calibration);
  EXPECT_NEAR(calibration.camera().intrinsics().fx / real.intrinsics.fx, 1.0, 0.003);
}

TEST(SelfCalibration, LeavesARightCalibrationAlone) {
  const SineRoom real;
  SelfCalibration calibration(real.intrinsics, {.enabled = true});
  walk(real, 20, calibration);
  const CameraIntrinsics& found = calibration.camera().intrinsics();
  EXPECT_NEAR(found.fx / real.intrinsics.fx, 1.0, 0.001);
  EXPECT_NEAR(found.k1, 0.0, 0.003);
}

TEST(SelfCalibration, NeverGoesBeyondThreeSigma) {
  SineRoom real;
  real.intrinsics.k1 = 0.05;
  CameraIntrinsics given = real.intrinsics;
  given.k1 = 0.0;
  SelfCalibrationConfig sure = kOpenMinded;
  sure.k1_sigma = 0.005;
  sure.believed_share = 1.0;
  SelfCalibration calibration(given, sure);
  walk(real, 20, calibration);
  EXPECT_LE(calibration.camera().intrinsics().k1, 0.015 + 1e-9);
  EXPECT_GT(calibration.camera().intrinsics().k1, 0.01);
}

TEST(SelfCalibration, ChangesNothingBeforeItHasSeenAnything) {
  const SineRoom room;
  SelfCalibration calibration(room.intrinsics, kOpenMinded);
  EXPECT_FALSE(calibration.update());
  EXPECT_EQ(calibration.camera().intrinsics().fx, room.intrinsics.fx);
}

}  // namespace
}  // namespace sparsight
