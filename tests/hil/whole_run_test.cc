#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>

#include "tests/hil/guest_run.h"
#include "tests/system/program.h"

namespace sparsight {
namespace {

using std::chrono::microseconds;
using std::chrono::nanoseconds;

double microseconds_of(nanoseconds duration) {
  return 1e-3 * static_cast<double>(duration.count());
}

class WholeRun : public ::testing::Test {
 protected:
  // Judged once: comparing the recordings and replaying them takes seconds.
  static const GuestRun& run() {
    static const GuestRun whole = guest_run("whole");
    return whole;
  }
};

TEST_F(WholeRun, BeginsAndEndsAsItShould) {
  EXPECT_EQ(run().hil_status, 0) << "sparsight hil could not play all it had";
  EXPECT_EQ(run().run_status, 0) << run().said;
  EXPECT_EQ(run().session.at("complete"), true);
  EXPECT_LE(run().session.at("live").at("first_pose_s").get<double>(), 2.0);
  EXPECT_TRUE(run().showed("/camera/state", "streaming"));
  EXPECT_TRUE(run().showed("/lidar/state", "streaming"));
  EXPECT_TRUE(run().showed("/trigger/state", "streaming"));
}

TEST_F(WholeRun, RecordsEveryFrameByteForByte) {
  const RecordingComparison& recorded = run().recorded;
  EXPECT_TRUE(recorded.frames.all_equal())
      << recorded.frames.missing << " missing, " << recorded.frames.foreign << " foreign of "
      << recorded.frames.in;
  EXPECT_EQ(recorded.sequence_gaps, 0U);
  EXPECT_EQ(recorded.camera_starts, 1U);
  EXPECT_LE(recorded.worst_frame_stamp, microseconds(1)) << "all the digits that V4L2 has";
  std::printf("frames %lu in, %lu out, equal\n", recorded.frames.in, recorded.frames.out);
}

TEST_F(WholeRun, RecordsEveryPacketByteForByte) {
  const RecordingComparison& recorded = run().recorded;
  EXPECT_TRUE(recorded.packets.all_equal())
      << recorded.packets.missing << " missing, " << recorded.packets.foreign << " foreign of "
      << recorded.packets.in;
  EXPECT_TRUE(recorded.positions.all_equal())
      << recorded.positions.missing << " missing, " << recorded.positions.foreign << " foreign of "
      << recorded.positions.in;
  std::printf("packets %lu + %lu in, %lu + %lu out, equal\n", recorded.packets.in,
              recorded.positions.in, recorded.packets.out, recorded.positions.out);
}

TEST_F(WholeRun, RecordsEveryEdgeWhenItHappened) {
  for (const EdgeComparison& edges : {run().recorded.exposures, run().recorded.pulses}) {
    EXPECT_GT(edges.in, 0U);
    EXPECT_EQ(edges.matched, edges.in);
    EXPECT_EQ(edges.out, edges.in);
    EXPECT_LE(edges.most_late, microseconds(50));
    EXPECT_GE(edges.least_late, nanoseconds(0));
    std::printf("edges %lu in, %lu matched; stamped %.1f us after they were due, at most %.1f\n",
                edges.in, edges.matched, microseconds_of(edges.median_late),
                microseconds_of(edges.most_late));
  }
}

// A frame that was given another's edge would be a period off.
TEST_F(WholeRun, GivesEachFrameItsOwnExposure) {
  const Trajectory& replayed = replayed_path();
  const auto& times = run().path.times;
  ASSERT_FALSE(times.empty());
  nanoseconds worst{0};
  for (const HostTime time : times) {
    const auto next = std::ranges::lower_bound(replayed.times, time);
    nanoseconds nearest = std::chrono::seconds(1);
    if (next != replayed.times.end()) nearest = *next - time;
    if (next != replayed.times.begin()) nearest = std::min(nearest, time - *(next - 1));
    worst = std::max(worst, nearest);
  }
  EXPECT_LE(worst, microseconds(50));
  const auto& sync = run().last().at("sync");
  EXPECT_EQ(sync.at("edges_lost"), 0);
  EXPECT_EQ(sync.at("frames_estimated"), 0);
  EXPECT_EQ(sync.at("edges_matched").get<std::size_t>(), replayed.times.size());
  std::printf("exposures of %zu frames as in the replay, at most %.1f us off\n", times.size(),
              microseconds_of(worst));
}

TEST_F(WholeRun, TracksAsItsReplayDoes) {
  const AbsoluteError live = error_of(run().path);
  const AbsoluteError replayed = error_of(replayed_path());
  EXPECT_LE(live.rmse_m, replayed.rmse_m + 0.005);
  EXPECT_LE(live.rmse_m, 0.03);
  std::printf("ATE %.4f m in the guest, %.4f m in the replay\n", live.rmse_m, replayed.rmse_m);
}

TEST_F(WholeRun, LeavesARecordingThatReplaysToTheSamePath) {
  const Trajectory again = replay(run().folder / "session" / "recording.mcap");
  const Trajectory& before = replayed_path();
  ASSERT_EQ(again.poses.size(), before.poses.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < before.poses.size(); ++i) {
    const auto apart = again.poses[i].translation() - before.poses[i].translation();
    worst = std::max(worst, apart.norm());
  }
  EXPECT_LE(worst, 0.005);
  std::printf("its replay is at most %.2f mm from that of the recording that went in\n",
              1e3 * worst);
}

// The search on the first two frames takes a processor of 500 MIPS a tenth of a second.
TEST_F(WholeRun, KeepsEveryDeadlineOnceItIsUnderWay) {
  const auto& settled = run().settled();
  const auto& last = run().last();
  for (const char* count : {"deadlines_missed", "frames_dropped", "predicted", "records_dropped"}) {
    EXPECT_EQ(last.at(count), settled.at(count)) << count;
  }
  double latest = 0.0;
  double median = 0.0;
  double arrival = 0.0;
  for (const auto& state : run().states) {
    if (state.at("frames") <= settled.at("frames")) continue;
    const auto& pose = state.at("exposure_to_pose_ms");
    latest = std::max(latest, pose.at("p99").get<double>());
    median = std::max(median, pose.at("p50").get<double>());
    arrival = std::max(arrival, state.at("arrival_to_pose_ms").at("p99").get<double>());
  }
  EXPECT_GT(arrival, 0.0);
  EXPECT_LE(arrival, 25.0) << "from a frame's arrival to its pose, the worst of any second";
  std::printf(
      "middle of the exposure to pose: median %.1f ms, worst %.1f ms; arrival to pose: worst %.1f "
      "ms\n",
      median, latest, arrival);
}

TEST_F(WholeRun, RaisesTheInterruptsOfItsLinesAndOfItsNetworkCard) {
  const std::string threads = text_of(run().folder / "threads.txt");
  EXPECT_THAT(threads, ::testing::ContainsRegex("irq/[0-9]+-sparsig[a-z]* [0-9]+ [0-9]+ 85"))
      << threads;
  EXPECT_THAT(threads, ::testing::ContainsRegex("irq/[0-9]+-lidar[-a-z0-9]* [0-9]+ [0-9]+ 75"))
      << threads;
  EXPECT_THAT(threads, ::testing::ContainsRegex("irq/[0-9]+-senso[-a-z0-9]* [0-9]+ [0-9]+ 50"))
      << "the sensor's own card is none of ours: " << threads;
  EXPECT_THAT(threads, ::testing::ContainsRegex("tracking [0-9]+ [0-9]+ 40")) << threads;
}

}  // namespace
}  // namespace sparsight
