#include "tools/session/captured_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "realtime/pipeline/deterministic_replay.h"
#include "tests/drivers/datasets/made_capture_folder.h"
#include "tests/tools/session/made_walk.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using testing::MadeWalk;
using testing::TemporaryFolder;
namespace fs = std::filesystem;

using Path = std::map<HostTime, Eigen::Isometry3d>;

Path tracked(FrameSource& source, std::chrono::nanoseconds to_host_time) {
  Odometry odometry(source.calibration(), {});
  Path path;
  const ReplayTrajectories replayed = replay_deterministic(source, odometry, std::nullopt, {});
  for (const TrajectoryPose& pose : replayed.odometry) {
    // Both know the exposure to some microseconds, and frames are 33 ms apart.
    path[HostTime(std::chrono::round<std::chrono::milliseconds>(
        pose.exposure.time_since_epoch() + to_host_time))] = pose.T_world_camera;
  }
  return path;
}

TEST(CapturedFrames, GiveThePathThatTheRecordingOfTheSameWalkGives) {
  const MadeWalk& walk = MadeWalk::shared();
  const TemporaryFolder temporary;
  testing::write_recording(temporary.path() / "walk.mcap", walk.events, walk.rig);
  testing::write_capture_folder(temporary.path() / "walk", walk);

  auto recording = open_source(temporary.path() / "walk.mcap", {});
  ASSERT_TRUE(recording) << recording.error().message;
  const Path recorded = tracked(*recording->frames, 0s);
  auto capture = open_source(temporary.path() / "walk", {});
  ASSERT_TRUE(capture) << capture.error().message;
  EXPECT_EQ(capture->frames->frame_count(), walk.simulation->ground_truth().exposures().size());
  const Path captured = tracked(*capture->frames, -testing::kSince1970);
  EXPECT_EQ(captured.size(), capture->frames->frame_count());
  EXPECT_THAT(capture->remarks(), ::testing::SizeIs(::testing::Le(1)));

  ASSERT_GE(recorded.size(), 45U);
  const auto& [begin, recorded_begin] = *recorded.begin();
  ASSERT_TRUE(captured.contains(begin));
  const SimulatedTruth& truth = walk.simulation->ground_truth();
  double worst = 0.0;
  double worst_of_truth = 0.0;
  for (const auto& [time, pose] : recorded) {
    ASSERT_TRUE(captured.contains(time));
    const Eigen::Isometry3d by_capture = captured.at(begin).inverse() * captured.at(time);
    const Eigen::Isometry3d by_recording = recorded_begin.inverse() * pose;
    const Eigen::Isometry3d really = truth.camera_pose(begin).inverse() * truth.camera_pose(time);
    worst = std::max(worst, (by_capture.translation() - by_recording.translation()).norm());
    worst_of_truth =
        std::max(worst_of_truth, (by_capture.translation() - really.translation()).norm());
  }
  RecordProperty("worst_mm", fmt::format("{:.2f}", 1e3 * worst));
  RecordProperty("worst_of_truth_mm", fmt::format("{:.2f}", 1e3 * worst_of_truth));
  EXPECT_LT(worst, 0.02);
  EXPECT_LT(worst_of_truth, 0.02);
}

TEST(CapturedFrames, NameTheImageThatCannotBeReadAndGoOn) {
  const testing::MadeCaptureFolder made;
  testing::truncate_file(made.image(3), 0.5);
  auto source = open_source(made.folder, {.rays = 4});
  ASSERT_TRUE(source) << source.error().message;
  int count = 0;
  while (const auto frame = source->frames->next()) {
    if (count++ != 3) {
      EXPECT_FALSE(frame->grey.empty());
      continue;
    }
    EXPECT_TRUE(frame->grey.empty());
    ASSERT_EQ(frame->faults.size(), 1U);
    EXPECT_THAT(frame->faults[0].message, ::testing::HasSubstr("frame_4.png: not a readable PNG"));
  }
  EXPECT_EQ(count, 10);
}

TEST(CapturedFrames, NeedACalibration) {
  const testing::MadeCaptureFolder made;
  testing::write_file(made.folder / "rig.toml", "name = \"bare\"\n");
  const auto source = open_source(made.folder, {});
  ASSERT_FALSE(source);
  EXPECT_THAT(source.error().message,
              ::testing::HasSubstr("rig.toml: has no [calibration.camera]"));
}

}  // namespace
}  // namespace sparsight
