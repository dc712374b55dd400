#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>

#include "drivers/vlp16/wire_format.h"
#include "tests/drivers/simulated/bare_room.h"

namespace sparsight {
namespace {

using std::chrono::milliseconds;
using testing::events_in_bare_room;
using testing::SimulatedEvents;
using testing::small_options;

std::int64_t simulated_hour_us(const LidarPacket& packet) {
  return wire::from_bytes<wire::DataPacket>(packet.payload).microseconds_past_hour;
}

TEST(SimulatedFaults, LostFramesLeaveGapsInTheSequence) {
  SimulationOptions options = small_options(2.0);
  options.faults.lost_frames = 0.3;
  const SimulatedEvents events = events_in_bare_room(options);
  EXPECT_LT(events.frames.size(), 52U);
  EXPECT_GT(events.frames.size(), 30U);
  EXPECT_GE(events.frames.back().sequence, events.frames.size());
  EXPECT_EQ(events.exposure_edges.size(), 2 * ((events.exposure_edges.size() + 1) / 2));
  EXPECT_GE(events.exposure_edges.size(), 118U);  // the exposures took place
}

TEST(SimulatedFaults, LostEdgesLeaveTheFrames) {
  SimulationOptions options = small_options(2.0);
  options.faults.lost_edges = 0.2;
  const SimulatedEvents events = events_in_bare_room(options);
  EXPECT_GE(events.frames.size(), 59U);
  EXPECT_LT(events.exposure_edges.size(), 112U);
  EXPECT_GT(events.exposure_edges.size(), 75U);
}

TEST(SimulatedFaults, LostPacketsAreMissingFromTheTimeline) {
  SimulationOptions options = small_options();
  const SimulatedEvents whole = events_in_bare_room(options);
  options.faults.lost_packets = 0.1;
  const SimulatedEvents events = events_in_bare_room(options);
  EXPECT_NEAR(static_cast<double>(events.packets.size()),
              0.9 * static_cast<double>(whole.packets.size()), 25.0);
  // Those that remain are those of the whole recording.
  std::size_t found = 0;
  for (const LidarPacket& packet : whole.packets) {
    if (found < events.packets.size() && packet.payload == events.packets[found].payload) ++found;
  }
  EXPECT_EQ(found, events.packets.size());
}

TEST(SimulatedFaults, ClockJumpSetsTheLidarsClockOn) {
  SimulationOptions options = small_options();
  options.pps = false;
  options.faults.lidar_clock_jump = {milliseconds(500), std::chrono::seconds(100)};
  const SimulatedEvents events = events_in_bare_room(options);
  int jumps = 0;
  for (std::size_t i = 1; i < events.packets.size(); ++i) {
    const std::int64_t step =
        simulated_hour_us(events.packets[i]) - simulated_hour_us(events.packets[i - 1]);
    if (step == 1327 || step == 1328) continue;
    ++jumps;
    EXPECT_NEAR(static_cast<double>(step), 100e6 + 1327.1, 1.0);
    EXPECT_NEAR(to_seconds(events.packets[i].arrival - options.start), 0.502, 0.004);
  }
  EXPECT_EQ(jumps, 1);
}

TEST(SimulatedFaults, CameraComesBackInANewEpoch) {
  SimulationOptions options = small_options();
  options.faults.away = {{DeviceKind::kCamera, milliseconds(300), milliseconds(400)}};
  const SimulatedEvents events = events_in_bare_room(options);
  ASSERT_EQ(events.changes.size(), 2U);
  EXPECT_EQ(events.changes[0].state, DeviceState::kGone);
  EXPECT_EQ(events.changes[1].state, DeviceState::kStreaming);
  EXPECT_EQ(events.changes[1].at - events.changes[0].at, milliseconds(400));
  const auto second = std::ranges::find(events.frames, 1U, &CameraFrame::epoch);
  ASSERT_NE(second, events.frames.end());
  EXPECT_EQ(second->sequence, 0U);
  EXPECT_GT(second->arrival, events.changes[1].at);
  EXPECT_EQ(events.exposure_edges.size(), 2 * events.frames.size());
  EXPECT_GT(events.packets.size(), 750U);
}

TEST(SimulatedFaults, LidarAndTriggerGoAwayAlone) {
  SimulationOptions options = small_options();
  options.faults.away = {{DeviceKind::kLidar, milliseconds(100), milliseconds(500)},
                         {DeviceKind::kTrigger, milliseconds(200), milliseconds(5000)}};
  const SimulatedEvents events = events_in_bare_room(options);
  EXPECT_NEAR(static_cast<double>(events.packets.size()), 377.0, 3.0);
  EXPECT_NEAR(static_cast<double>(events.exposure_edges.size()), 12.0, 2.0);
  EXPECT_GE(events.frames.size(), 29U);
  EXPECT_EQ(events.changes.size(), 3U);  // the trigger does not come back
}

}  // namespace
}  // namespace sparsight
