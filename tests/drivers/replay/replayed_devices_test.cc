#include "drivers/replay/replayed_devices.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/drivers/replay/listed_events.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;

OpenEvents listed(std::vector<RigEvent> events) {
  return [events] { return std::make_unique<ListedEvents>(events); };
}

TEST(ReplayedDevices, TakeTheirOwnAndLeaveTheRest) {
  ReplayedLidar lidar(listed({Edge{}, LidarPacket{.arrival = HostTime(1s)}, Edge{},
                              PositionPacket{.arrival = HostTime(2s)}}));
  ASSERT_TRUE(lidar.start());
  EXPECT_EQ(std::get<LidarPacket>(*lidar.read(0ns)).arrival, HostTime(1s));
  EXPECT_EQ(std::get<PositionPacket>(*lidar.read(0ns)).arrival, HostTime(2s));
  EXPECT_FALSE(lidar.read(0ns));
  EXPECT_EQ(lidar.state(), DeviceState::kEnded);
}

TEST(ReplayedDevices, FollowTheRecordedStatesOfTheirOwnDevice) {
  ReplayedTriggerLine line(
      listed({DeviceStateChange{DeviceKind::kCamera, DeviceState::kGone, HostTime(1s)}, Edge{},
              DeviceStateChange{DeviceKind::kTrigger, DeviceState::kSilent, HostTime(2s)}, Edge{},
              DeviceStateChange{DeviceKind::kTrigger, DeviceState::kStopped, HostTime(3s)}}));
  ASSERT_TRUE(line.start());
  EXPECT_TRUE(line.read(0ns));
  EXPECT_EQ(line.state(), DeviceState::kStreaming);
  EXPECT_TRUE(line.read(0ns));
  EXPECT_EQ(line.state(), DeviceState::kSilent);
  EXPECT_FALSE(line.read(0ns));
  EXPECT_EQ(line.state(), DeviceState::kEnded);
}

TEST(ReplayedDevices, WhatCannotBeOpenedIsNotStarted) {
  ReplayedCamera camera([]() -> Result<std::unique_ptr<RigEventSource>> {
    return fail(ErrorCode::kNotFound, "a.mcap: not there");
  });
  const auto started = camera.start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().message, "a.mcap: not there");
  EXPECT_EQ(camera.state(), DeviceState::kStopped);
}

}  // namespace
}  // namespace sparsight
