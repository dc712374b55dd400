#include <gtest/gtest.h>

#include <algorithm>

#include "slam/odometry.h"
#include "tests/slam/room_rig.h"

// What moves by itself, and what a rig cannot do.

namespace sparsight {
namespace {

using Status = FrameOutcome::Status;

FrameOutcome feed(Odometry& odometry, const SynchronizedFrame& frame) {
  FrameOutcome outcome = odometry.track(frame);
  if (outcome.becomes_keyframe) odometry.add_keyframe(frame);
  return outcome;
}

OdometryConfig config_with(bool sweep_arbiter) {
  OdometryConfig config = room_config();
  config.tracker.sweep_arbiter = sweep_arbiter;
  config.tracker.automatic_top_level = true;
  config.tracker.max_acceleration_m_s2 = 30.0;
  config.photometry.patch_weights = true;
  config.photometry.affine_brightness = true;
  config.photometry.weigh_down_strangers = true;
  return config;
}

// `image` from column `first` on, before that the frame's own.
void paste(SynchronizedFrame& frame, const GreyImage& image, int first) {
  for (int v = 0; v < image.height; ++v) {
    for (int u = first; u < image.width; ++u) {
      const std::size_t at = static_cast<std::size_t>(v) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(u);
      frame.grey.pixels[at] = image.pixels[at];
    }
  }
}

// The largest error while traffic with a texture of its own comes from the right until it fills two
// thirds of the image, and the sweep sees the room as it is.
double error_in_traffic(bool sweep_arbiter) {
  RoomRig rig;
  rig.speed_m_s = 0.1;
  rig.turn_rad_s = 0.0;
  Odometry odometry(rig.calibration(), config_with(sweep_arbiter));
  double worst = 0.0;
  const SineRoom traffic{.pattern = 5};
  for (int i = 0; i < 30; ++i) {
    SynchronizedFrame frame = rig.frame(i);
    const int first = std::max(50, 160 - 15 * std::max(0, i - 5));
    paste(frame, traffic.image(pose(0, 0, 0, 0.1 * (i - 20), 0, 0)), first);
    const FrameOutcome outcome = feed(odometry, frame);
    worst = std::max(worst, shift_between(outcome.T_world_camera, rig.T_world_camera(i)));
  }
  return worst;
}

TEST(OdometryInTraffic, StaysWithWhatTheLidarSeesStanding) {
  EXPECT_LT(error_in_traffic(true), 0.2);
  EXPECT_GT(error_in_traffic(false), 1.0) << "else there was nothing to withstand";
}

// A lorry drives on as we do, and has been in the way for three frames.
TEST(OdometryInTraffic, RefusesAPoseThatNoRigReachesAfterFramesInDoubt) {
  const RoomRig rig;
  Odometry odometry(rig.calibration(), config_with(false));
  for (int i = 0; i < 6; ++i) feed(odometry, rig.frame(i));
  SineRoom blank = rig.room;
  blank.contrast = 0.0;
  const GreyImage lorry = blank.image(rig.T_world_camera(6));
  for (int i = 6; i < 9; ++i) {
    SynchronizedFrame frame = rig.frame(i);
    paste(frame, lorry, 70);
    const FrameOutcome outcome = feed(odometry, frame);
    EXPECT_FALSE(outcome.tracking.well_found()) << i;
  }
  SynchronizedFrame frame = rig.frame(9);
  frame.grey = rig.room.image(rig.T_world_camera(9) * pose(0, 0, 0, 0, 0, 0.8));
  const FrameOutcome outcome = feed(odometry, frame);
  EXPECT_EQ(outcome.status, Status::kPredicted);
  EXPECT_LT(shift_between(outcome.T_world_camera, rig.T_world_camera(9)), 0.15);
}

// Nothing has confirmed the velocity that a first step pretends.
TEST(OdometryInTraffic, TakesTheRightPoseAfterAWrongFirstStep) {
  const RoomRig rig;
  Odometry odometry(rig.calibration(), config_with(false));
  feed(odometry, rig.frame(0));
  SynchronizedFrame wrong = rig.frame(1);
  wrong.grey = rig.room.image(rig.T_world_camera(1) * pose(0, 0, 0, 0, 0, 0.5));
  EXPECT_GT(feed(odometry, wrong).T_world_camera.translation().norm(), 0.4);
  for (int i = 2; i < 8; ++i) {
    const FrameOutcome outcome = feed(odometry, rig.frame(i));
    EXPECT_EQ(outcome.status, Status::kTracked) << i;
    if (outcome.keyframe_sequence == 0) {
      EXPECT_LT(shift_between(outcome.T_world_camera, rig.T_world_camera(i)), 0.02) << i;
    }
  }
}

// With the lens covered nothing is found, and a sweep alone makes no pose.
TEST(OdometryInTraffic, IsLostInTheDarkHoweverSureTheLidarIs) {
  const RoomRig rig;
  Odometry odometry(rig.calibration(), config_with(true));
  for (int i = 0; i < 6; ++i) feed(odometry, rig.frame(i));
  FrameOutcome outcome;
  for (int i = 6; i < 12; ++i) {
    SynchronizedFrame dark = rig.frame(i);
    std::fill(dark.grey.pixels.begin(), dark.grey.pixels.end(), std::uint8_t{0});
    outcome = feed(odometry, dark);
  }
  EXPECT_EQ(outcome.status, Status::kLost);
}

}  // namespace
}  // namespace sparsight
