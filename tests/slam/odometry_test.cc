#include "slam/odometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>

#include "tests/slam/room_rig.h"

namespace sparsight {
namespace {

GreyImage black() {
  return analytic_image(160, 120, [](double, double) { return 0.0; });
}

using Status = FrameOutcome::Status;

// One run, as realtime/pipeline drives it.
struct Drive {
  explicit Drive(const RoomRig& rig, const OdometryConfig& config = room_config())
      : odometry(rig.calibration(), config) {}

  FrameOutcome feed(const SynchronizedFrame& frame) {
    const FrameOutcome outcome = odometry.track(frame);
    if (outcome.becomes_keyframe) {
      odometry.add_keyframe(frame);
      keyframes.push_back(frame.sequence);
    }
    for (RetiredKeyframe& keyframe : odometry.take_retired()) {
      retired.push_back(std::move(keyframe));
    }
    return outcome;
  }
  void finish() {
    odometry.finish();
    for (RetiredKeyframe& keyframe : odometry.take_retired()) {
      retired.push_back(std::move(keyframe));
    }
  }

  Odometry odometry;
  std::vector<std::uint64_t> keyframes;
  std::vector<RetiredKeyframe> retired;
};

TEST(Odometry, FirstFrameDefinesTheWorld) {
  const RoomRig rig;
  Drive run(rig);
  const FrameOutcome first = run.feed(rig.frame(7));
  EXPECT_EQ(first.status, Status::kFirst);
  EXPECT_TRUE(first.becomes_keyframe);
  EXPECT_EQ(first.T_world_camera.matrix(), Eigen::Matrix4d::Identity());
  EXPECT_EQ(first.keyframe_sequence, 7U);
}

TEST(Odometry, FollowsACurve) {
  const RoomRig rig;
  Drive run(rig);
  for (int i = 0; i < 25; ++i) {
    const FrameOutcome outcome = run.feed(rig.frame(i));
    EXPECT_EQ(outcome.status, i == 0 ? Status::kFirst : Status::kTracked) << i;
    EXPECT_LT(shift_between(outcome.T_world_camera, rig.T_world_camera(i)), 0.01) << i;
    EXPECT_LT(turn_between(outcome.T_world_camera, rig.T_world_camera(i)), 2e-3) << i;
  }
  EXPECT_GE(run.keyframes.size(), 3U);
}

TEST(Odometry, WaitsForAFrameWithImageAndDepth) {
  const RoomRig rig;
  Drive run(rig);
  SynchronizedFrame blind = rig.frame(0);
  blind.grey = {};
  SynchronizedFrame flat = rig.frame(1);
  flat.sweep.returns.clear();
  SynchronizedFrame sparse = rig.frame(2);
  sparse.sweep.returns.resize(5);
  for (const SynchronizedFrame& frame : {blind, flat}) {
    const FrameOutcome outcome = run.feed(frame);
    EXPECT_EQ(outcome.status, Status::kPredicted);
    EXPECT_FALSE(outcome.becomes_keyframe);
  }
  run.feed(sparse);  // too few points: no keyframe comes of it
  const FrameOutcome first = run.feed(rig.frame(3));
  EXPECT_EQ(first.status, Status::kFirst);
  EXPECT_EQ(run.feed(rig.frame(4)).keyframe_sequence, 3U);
}

TEST(Odometry, PredictsAFrameWithoutImageAndSaysSo) {
  const RoomRig rig;
  Drive run(rig);
  for (int i = 0; i < 6; ++i) run.feed(rig.frame(i));
  SynchronizedFrame blind = rig.frame(6);
  blind.grey = {};
  const FrameOutcome outcome = run.feed(blind);
  EXPECT_EQ(outcome.status, Status::kPredicted);
  EXPECT_FALSE(outcome.tracking.ok());
  EXPECT_FALSE(outcome.becomes_keyframe);
  EXPECT_LT(shift_between(outcome.T_world_camera, rig.T_world_camera(6)), 0.01);
  EXPECT_GT(shift_between(outcome.T_world_camera, rig.T_world_camera(5)), 0.03) << "it moved on";
  const FrameOutcome next = run.feed(rig.frame(7));
  EXPECT_EQ(next.status, Status::kTracked);
  EXPECT_LT(shift_between(next.T_world_camera, rig.T_world_camera(7)), 0.01);
}

TEST(Odometry, TracksAFrameWithoutDepthButMakesNoKeyframeOfIt) {
  const RoomRig rig;
  Drive run(rig);
  run.feed(rig.frame(0));
  for (int i = 1; i < 15; ++i) {
    SynchronizedFrame flat = rig.frame(i);
    flat.sweep.returns.clear();
    const FrameOutcome outcome = run.feed(flat);
    EXPECT_EQ(outcome.status, Status::kTracked) << i;
    EXPECT_FALSE(outcome.becomes_keyframe) << i;
  }
  EXPECT_TRUE(run.feed(rig.frame(15)).becomes_keyframe) << "overdue";
}

// A hand over the lens for half a second.
TEST(Odometry, SaysSoWhileItSeesNothingAndFindsItsWayAgain) {
  const RoomRig rig;
  Drive run(rig);
  for (int i = 0; i < 8; ++i) run.feed(rig.frame(i));
  for (int i = 8; i < 13; ++i) {
    SynchronizedFrame dark = rig.frame(i);
    dark.grey = black();
    const FrameOutcome outcome = run.feed(dark);
    EXPECT_EQ(outcome.status, i < 10 ? Status::kPredicted : Status::kLost) << i;
    EXPECT_LT(shift_between(outcome.T_world_camera, rig.T_world_camera(i)), 0.03) << i;
  }
  int tracked = 0;
  for (int i = 13; i < 20; ++i) {
    const FrameOutcome outcome = run.feed(rig.frame(i));
    tracked += outcome.status == Status::kTracked ? 1 : 0;
    EXPECT_LT(shift_between(outcome.T_world_camera, rig.T_world_camera(i)), 0.05) << i;
  }
  EXPECT_GE(tracked, 6);
}

// Frames of the rig at one time, as if they had been taken at another.
SynchronizedFrame at_another_time(const RoomRig& rig, int seen, int i) {
  SynchronizedFrame frame = rig.frame(seen);
  frame.sequence = static_cast<std::uint64_t>(i);
  frame.exposure = HostTime(std::chrono::milliseconds(100 * i));
  return frame;
}

SynchronizedFrame covered(const RoomRig& rig, int seen, int i) {
  SynchronizedFrame frame = at_another_time(rig, seen, i);
  frame.grey = black();
  return frame;
}

constexpr int kUncovered = 60;  // the lens was covered for five seconds

TEST(Odometry, WithTheLensCoveredForLongItIsLostWithinHalfASecondAndFoundWhereItWas) {
  const RoomRig rig;
  Drive run(rig);
  for (int i = 0; i < 10; ++i) run.feed(rig.frame(i));
  for (int i = 10; i < kUncovered; ++i) {
    const FrameOutcome outcome = run.feed(covered(rig, 9, i));
    if (i >= 14) {
      EXPECT_EQ(outcome.status, Status::kLost) << i;
    }
  }
  for (int i = kUncovered; i < kUncovered + 5; ++i) {
    const FrameOutcome outcome = run.feed(at_another_time(rig, 9, i));
    EXPECT_EQ(outcome.status, Status::kTracked) << i;
    EXPECT_EQ(outcome.submap, 0U) << "what it sees is what it saw last";
    EXPECT_LT(shift_between(outcome.T_world_camera, rig.T_world_camera(9)), 0.02) << i;
  }
}

// To where nothing of the last keyframe is seen: the other way.
RoomRig carried_off() {
  RoomRig rig;
  rig.T_world_start.linear() =
      Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  return rig;
}

TEST(Odometry, CarriedOffItIsLostWithinHalfASecondAndGoesOnInASubmapOfItsOwn) {
  const RoomRig rig;
  const RoomRig elsewhere = carried_off();
  Drive run(rig);
  for (int i = 0; i < 10; ++i) run.feed(rig.frame(i));
  std::optional<FrameOutcome> reference;
  int lost = 0;
  for (int i = 10; i < 30; ++i) {
    const FrameOutcome outcome = run.feed(elsewhere.frame(i));
    lost += outcome.status == Status::kLost ? 1 : 0;
    if (i < 15) continue;
    EXPECT_EQ(outcome.status, Status::kTracked) << i;
    EXPECT_EQ(outcome.submap, 1U) << i;
    if (!reference) reference = outcome;
    const Eigen::Isometry3d moved =
        elsewhere.T_world_camera(15).inverse() * elsewhere.T_world_camera(i);
    EXPECT_LT(shift_between(reference->T_world_camera.inverse() * outcome.T_world_camera, moved),
              0.02)
        << i;
  }
  EXPECT_GE(lost, 1);
  run.finish();
  const auto begins = std::ranges::find_if(run.retired, &RetiredKeyframe::begins_submap);
  ASSERT_NE(begins, run.retired.end());
  ASSERT_NE(begins, run.retired.begin());
  EXPECT_FALSE(std::prev(begins)->successor) << "nothing ties what was before to what came after";
}

TEST(Odometry, InTheDarkNoSubmapBegins) {
  const RoomRig rig;
  const RoomRig elsewhere = carried_off();
  Drive run(rig);
  for (int i = 0; i < 10; ++i) run.feed(rig.frame(i));
  for (int i = 10; i < kUncovered; ++i) EXPECT_EQ(run.feed(covered(rig, 9, i)).submap, 0U);
  const auto light = [&](int i) { return at_another_time(elsewhere, i - kUncovered + 10, i); };
  for (int i = kUncovered; i < kUncovered + 3; ++i) run.feed(light(i));
  EXPECT_EQ(run.feed(light(kUncovered + 3)).submap, 1U) << "of the first light";
}

// The start of a recording, with the lens cap on.
TEST(Odometry, ReportsNoMotionFromTheDark) {
  const RoomRig rig;
  Drive run(rig);
  for (int i = 0; i < 5; ++i) {
    SynchronizedFrame dark = rig.frame(i);
    dark.grey = black();
    EXPECT_NE(run.feed(dark).status, Status::kTracked) << i;
  }
  int tracked = 0;
  for (int i = 5; i < 12; ++i) tracked += run.feed(rig.frame(i)).status == Status::kTracked ? 1 : 0;
  EXPECT_GE(tracked, 5);
}

TEST(Odometry, MakesAKeyframeInTimeWhileStandingStill) {
  RoomRig rig;
  rig.speed_m_s = 0.0;
  rig.turn_rad_s = 0.0;
  OdometryConfig config = room_config();
  config.keyframes.max_age_s = 0.5;
  Drive run(rig, config);
  for (int i = 0; i < 17; ++i) {
    SynchronizedFrame frame = rig.frame(0);
    frame.sequence = static_cast<std::uint64_t>(i);
    frame.exposure = HostTime(std::chrono::milliseconds(100 * i));
    run.feed(frame);
  }
  EXPECT_EQ(run.keyframes, (std::vector<std::uint64_t>{0, 1, 6, 11, 16}));
}

TEST(Odometry, MakesAKeyframeWhereTooLittleIsSharedAndNotBefore) {
  RoomRig rig;
  rig.turn_rad_s = 0.6;
  rig.speed_m_s = 0.0;
  OdometryConfig config = room_config();
  config.keyframes.max_age_s = 1e9;
  Drive run(rig, config);
  for (int i = 0; i < 20; ++i) {
    const FrameOutcome outcome = run.feed(rig.frame(i));
    ASSERT_NE(outcome.status, Status::kPredicted) << i;
    if (i > 1) {
      EXPECT_EQ(outcome.becomes_keyframe, outcome.tracking.visible_ratio < 0.8) << i;
    }
  }
  EXPECT_GE(run.keyframes.size(), 4U);
  EXPECT_LE(run.keyframes.size(), 9U);
}

TEST(Odometry, KeepsTheWindowSmallAndRetiresInOrder) {
  const RoomRig rig;
  OdometryConfig config = room_config();
  config.keyframes.max_age_s = 0.2;
  config.window.size = 3;
  Drive run(rig, config);
  for (int i = 0; i < 24; ++i) {
    run.feed(rig.frame(i));
    ASSERT_LE(run.keyframes.size() - run.retired.size(), 3U);
    if (i > 1) {
      ASSERT_GE(run.keyframes.size() - run.retired.size(), 2U);
    }
  }
  run.finish();
  ASSERT_EQ(run.retired.size(), run.keyframes.size());
  for (std::size_t i = 0; i < run.retired.size(); ++i) {
    const RetiredKeyframe& keyframe = run.retired[i];
    EXPECT_EQ(keyframe.sequence, run.keyframes[i]);
    EXPECT_LT(shift_between(keyframe.T_world_camera,
                            rig.T_world_camera(static_cast<int>(keyframe.sequence))),
              0.01);
    EXPECT_GT(keyframe.cloud_camera.size(), 1000U);
    ASSERT_EQ(keyframe.successor.has_value(), i + 1 < run.retired.size());
    if (!keyframe.successor) continue;
    EXPECT_EQ(keyframe.successor->sequence, run.keyframes[i + 1]);
    EXPECT_EQ(Eigen::LLT<Matrix6d>(keyframe.successor->information).info(), Eigen::Success);
    const Eigen::Isometry3d T_true =
        rig.T_world_camera(static_cast<int>(keyframe.sequence)).inverse() *
        rig.T_world_camera(static_cast<int>(keyframe.successor->sequence));
    EXPECT_LT(shift_between(keyframe.successor->T_keyframe_successor, T_true), 3e-3);
  }
}

TEST(Odometry, ColoursTheCloudFromTheImage) {
  const RoomRig rig;
  for (const bool color : {false, true}) {
    Drive run(rig);
    SynchronizedFrame frame = rig.frame(0);
    if (color) {
      frame.color = ColorImage{160, 120, std::vector<std::uint8_t>(3UL * 160 * 120)};
      for (std::size_t i = 0; i < frame.color->rgb.size(); i += 3) frame.color->rgb[i + 1] = 200;
    }
    run.feed(frame);
    run.finish();
    ASSERT_EQ(run.retired.size(), 1U);
    for (const CloudPoint& point : run.retired[0].cloud_camera) {
      Eigen::Vector2d pixel;
      ASSERT_TRUE(rig.room.camera().project(point.p_camera.cast<double>(), pixel));
      const std::uint8_t grey = frame.grey.at(static_cast<int>(std::lround(pixel.x())),
                                              static_cast<int>(std::lround(pixel.y())));
      ASSERT_NEAR(point.rgb[0], color ? 0 : grey, 25);  // on the border between two pixels
      if (color) {
        ASSERT_EQ(point.rgb[1], 200);
      }
      ASSERT_EQ(point.intensity, 0.5F);
    }
  }
}

TEST(Odometry, SurvivesTimeThatGoesBackwards) {
  const RoomRig rig;
  Drive run(rig);
  for (int i = 0; i < 5; ++i) run.feed(rig.frame(i));
  SynchronizedFrame late = rig.frame(5);
  late.exposure = HostTime(std::chrono::milliseconds(150));
  EXPECT_TRUE(run.feed(late).T_world_camera.matrix().allFinite());
  const FrameOutcome next = run.feed(rig.frame(6));
  EXPECT_EQ(next.status, Status::kTracked);
  EXPECT_LT(shift_between(next.T_world_camera, rig.T_world_camera(6)), 0.01);
}

TEST(Odometry, GivesTheSameBytesEveryTime) {
  const RoomRig rig;
  std::vector<Eigen::Matrix4d> first;
  for (const int repetition : {0, 1}) {
    Drive run(rig);
    for (int i = 0; i < 15; ++i) {
      const Eigen::Matrix4d T = run.feed(rig.frame(i)).T_world_camera.matrix();
      if (repetition == 0) {
        first.push_back(T);
      } else {
        EXPECT_EQ(T, first[static_cast<std::size_t>(i)]) << i;
      }
    }
  }
}

}  // namespace
}  // namespace sparsight
