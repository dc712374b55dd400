#include "tools/doctor/sync_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tools/doctor/alignment_checks.h"
#include "tools/doctor/event_collector.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

SyncState good_state() {
  SyncState state;
  state.camera = {.locked = true,
                  .edges_matched = 1792,
                  .frames = 1800,
                  .frames_unsynchronized = 8,
                  .period = 33ms,
                  .edge_jitter = 5us,
                  .delay = 11ms,
                  .delay_spread = 300us};
  state.lidar = {
      .source = LidarClockSource::kPps, .offset = 5s, .uncertainty = 35us, .restarts = 1};
  state.packets.decoded = 1000;
  return state;
}

TEST(SyncChecks, AllIsWellWhereAllIsWell) {
  const auto checks = sync_checks(good_state());
  ASSERT_EQ(checks.size(), 3U);
  for (const Check& check : checks) EXPECT_EQ(check.verdict, Verdict::kOk) << check.found;
  EXPECT_THAT(checks[0].found, HasSubstr("100.0 % of 1800 frames"));
  EXPECT_THAT(checks[2].found, HasSubstr("by PPS: the host is 5.000000 s ahead"));
}

TEST(SyncChecks, LostEdgesAreWeighed) {
  SyncState state = good_state();
  state.camera.frames_estimated = 50;
  EXPECT_EQ(sync_checks(state)[0].verdict, Verdict::kWarn);
  state.camera.frames_unsynchronized = 400;
  EXPECT_EQ(sync_checks(state)[0].verdict, Verdict::kFail);
}

TEST(SyncChecks, FramesWithoutAnyEdgeAreNotFit) {
  SyncState state;
  state.camera.frames = 90;
  state.camera.frames_unsynchronized = 90;
  const auto checks = sync_checks(state);
  ASSERT_EQ(checks.size(), 1U);
  EXPECT_EQ(checks[0].verdict, Verdict::kFail);
  EXPECT_THAT(checks[0].fix, HasSubstr("[trigger] exposure_active"));
}

TEST(SyncChecks, ClocksThatWanderAreWarnedOf) {
  SyncState state = good_state();
  state.camera.edge_jitter = 1ms;
  state.lidar.restarts = 2;
  EXPECT_EQ(sync_checks(state)[1].verdict, Verdict::kWarn);
  EXPECT_THAT(sync_checks(state)[2].found, HasSubstr("begun anew 2 times"));
  state.camera.delay_spread = 20ms;
  state.lidar.restarts = 0;
  state.lidar.uncertainty = 2ms;
  EXPECT_THAT(sync_checks(state)[1].fix, HasSubstr("USB port"));
  EXPECT_EQ(sync_checks(state)[2].verdict, Verdict::kWarn);
  state.lidar.source = LidarClockSource::kNone;
  EXPECT_EQ(sync_checks(state)[2].verdict, Verdict::kFail);
}

TEST(AlignmentCheck, TellsOnlyWhatTheImagesTell) {
  EdgeAlignmentReport seen{.frames = 10, .edges = 20};
  EXPECT_THAT(alignment_check(seen, "").found, HasSubstr("cannot be told from 20 depth edges"));
  seen = {.frames = 10,
          .edges = 2000,
          .gradient = 1.0,
          .turned_gradient = 1.0,
          .share_worse = 0.5,
          .best_gradient = 1.02,
          .best_turn_deg = {1.0, 1.0, 0.0}};
  EXPECT_EQ(alignment_check(seen, "").verdict, Verdict::kWarn);
  EXPECT_THAT(alignment_check(seen, "").fix, HasSubstr("hardly tell"));
  seen.best_gradient = 1.5;
  EXPECT_EQ(alignment_check(seen, "").verdict, Verdict::kFail);
  EXPECT_THAT(alignment_check(seen, "").fix,
              HasSubstr("turned 1.00 deg upwards and 1.00 deg to the right"));
  seen.best_turn_deg = {0.0, 0.0, -0.5};
  EXPECT_EQ(alignment_check(seen, "").verdict, Verdict::kWarn);
  EXPECT_THAT(alignment_check(seen, "a.png").fix, HasSubstr("0.50 deg anticlockwise"));
}

TEST(EventCollector, GivesEventsInTheOrderOfTheirArrivalAndBoundsTheirBytes) {
  EventCollector collector(150);
  for (const int i : {3, 1, 2}) {
    auto frame = std::make_shared<CameraFrame>();
    frame->arrival = HostTime(std::chrono::seconds(i));
    frame->bytes.resize(100);
    collector.add(std::shared_ptr<const CameraFrame>(std::move(frame)));
  }
  collector.add(Edge{.time = HostTime(1500ms)});
  const auto events = collector.take();
  std::vector<HostTime> times;
  std::size_t bytes = 0;
  while (const auto event = events->next()) {
    times.push_back(arrival_of(*event));
    const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&*event);
    if (frame != nullptr) bytes += (*frame)->bytes.size();
  }
  EXPECT_THAT(times,
              ::testing::ElementsAre(HostTime(1s), HostTime(1500ms), HostTime(2s), HostTime(3s)));
  EXPECT_EQ(bytes, 100U);
  EXPECT_FALSE(collector.take()->next());
}

}  // namespace
}  // namespace sparsight
