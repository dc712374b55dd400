#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "drivers/recording/recording_source.h"
#include "tests/hil/guest_run.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;

std::uint64_t withheld(const GuestRun& run, const char* device) {
  return run.hil.at(device).at("withheld").get<std::uint64_t>();
}

void expect_all_packets(const GuestRun& run) {
  EXPECT_TRUE(run.recorded.packets.all_equal()) << run.recorded.packets.missing << " missing";
  EXPECT_TRUE(run.recorded.positions.all_equal()) << run.recorded.positions.missing << " missing";
}

void expect_all_edges(const GuestRun& run) {
  EXPECT_EQ(run.recorded.exposures.matched, run.recorded.exposures.in);
  EXPECT_EQ(run.recorded.pulses.matched, run.recorded.pulses.in);
}

void expect_whole_session(const GuestRun& run) {
  EXPECT_EQ(run.hil_status, 0);
  EXPECT_EQ(run.run_status, 0) << run.said;
  EXPECT_EQ(run.session.at("complete"), true);
  EXPECT_EQ(run.last().at("state"), "tracking");
}

TEST(CameraSilent, IsShownAndTrackedAcross) {
  const GuestRun run = guest_run("camera-silent");
  expect_whole_session(run);
  EXPECT_THAT(run.said, HasSubstr("camera is silent"));
  EXPECT_GT(withheld(run, "camera"), 10U);
  EXPECT_EQ(run.recorded.frames.missing, withheld(run, "camera"));
  EXPECT_EQ(run.recorded.frames.foreign, 0U);
  expect_all_packets(run);
  expect_all_edges(run);
  EXPECT_LE(error_of(run.path).max_m, 0.05);
}

// The camera of this one is vivid's, whose pictures have nothing to do with the recording. It is a
// thread of ordinary priority that numbers a frame by the time at which it gets to run: half a
// period late it leaves a number out, and woken early after that it gives one twice.
TEST(CameraUnplugged, ComesBackAndNothingElseIsLost) {
  const GuestRun run = guest_run("camera-unplugged");
  EXPECT_TRUE(run.showed("/camera/state", "gone"));
  EXPECT_THAT(run.said, HasSubstr("camera is gone"));
  EXPECT_EQ(run.last().at("camera").at("state"), "streaming");
  EXPECT_EQ(run.recorded.camera_starts, 2U);
  EXPECT_GE(run.recorded.frames.out, run.last().at("camera").at("events"));
  EXPECT_EQ(run.recorded.sequence_gaps, run.last().at("camera").at("lost")) << "by us";
  EXPECT_LE(run.recorded.sequence_gaps, 5U) << "of some 240, by the camera";
  expect_all_packets(run);
  expect_all_edges(run);
  EXPECT_EQ(run.session.at("complete"), true);
  EXPECT_EQ(run.run_status, 1) << "none of its frames has an edge";
}

TEST(LidarSilent, IsShownAndTrackedAcross) {
  const GuestRun run = guest_run("lidar-silent");
  expect_whole_session(run);
  EXPECT_EQ(run.said.find("lidar is gone"), std::string::npos);
  EXPECT_TRUE(run.showed("/lidar/state", "silent"));
  EXPECT_GT(withheld(run, "lidar"), 1000U);
  EXPECT_EQ(run.recorded.packets.missing + run.recorded.positions.missing, withheld(run, "lidar"));
  EXPECT_EQ(run.recorded.packets.foreign + run.recorded.positions.foreign, 0U);
  EXPECT_TRUE(run.recorded.frames.all_equal());
  expect_all_edges(run);
  EXPECT_LE(error_of(run.path).max_m, 0.05);
}

// Only the long form runs this one.
TEST(PacketsLost, AreCountedAndTrackedAcross) {
  const GuestRun run = guest_run("packets-lost");
  expect_whole_session(run);
  EXPECT_GT(run.recorded.packets.missing, 100U) << "netem was to lose one in fifty";
  EXPECT_GT(run.recorded.packets.foreign, 50U) << "and to double one in a hundred";
  EXPECT_GT(run.last().at("sync").at("packets_lost"), 100);
  EXPECT_TRUE(run.recorded.frames.all_equal());
  expect_all_edges(run);
  EXPECT_LE(error_of(run.path).max_m, 0.05);
}

TEST(EdgesLost, CostNoFrame) {
  const GuestRun run = guest_run("edges-lost");
  expect_whole_session(run);
  const RecordingComparison& recorded = run.recorded;
  EXPECT_GT(withheld(run, "trigger"), 10U);
  EXPECT_EQ(recorded.exposures.in - recorded.exposures.matched, withheld(run, "trigger"));
  EXPECT_EQ(recorded.exposures.out, recorded.exposures.matched);
  EXPECT_TRUE(recorded.frames.all_equal());
  expect_all_packets(run);
  const auto& sync = run.last().at("sync");
  EXPECT_EQ(sync.at("edges_lost"), withheld(run, "trigger") / 2) << "two edges an exposure";
  EXPECT_LE(error_of(run.path).max_m, 0.03);
}

TEST(DiskFull, EndsTheRecordingAndNothingElse) {
  const GuestRun run = guest_run("disk-full");
  expect_whole_session(run);
  EXPECT_EQ(run.last().at("recorder").at("state"), "ended: little space is left");
  EXPECT_THAT(run.said, HasSubstr("recording ended"));
  EXPECT_GT(run.recorded.frames.missing, 0U);
  EXPECT_GT(run.recorded.frames.equal, 60U);
  EXPECT_EQ(run.recorded.frames.foreign + run.recorded.packets.foreign, 0U);
  EXPECT_EQ(run.recorded.sequence_gaps, 0U) << "it ends early, without holes";
  const auto recording = RecordingSource::open(run.folder / "session" / "recording.mcap");
  ASSERT_TRUE(recording);
  EXPECT_FALSE((*recording)->info().truncated) << "closed properly";
  // Tracking went on to the last frame.
  ASSERT_FALSE(run.path.times.empty());
  EXPECT_LE(true_path().times.back() - run.path.times.back(), std::chrono::milliseconds(100));
  EXPECT_LE(error_of(run.path).rmse_m, 0.03);
}

}  // namespace
}  // namespace sparsight
