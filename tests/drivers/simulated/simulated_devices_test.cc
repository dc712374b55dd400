#include "drivers/simulated/simulated_devices.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tests/drivers/simulated/bare_room.h"

namespace sparsight {
namespace {

using std::chrono::milliseconds;
using testing::bare_room;
using testing::small_options;

SimulatedDevices made_devices(const SimulationOptions& options) {
  return SimulatedDevices(std::make_unique<SimulatedRig>(options, bare_room()), options.start);
}

TEST(SimulatedDevices, DeliverOnlyWhenStarted) {
  SimulatedDevices devices = made_devices(small_options(0.3));
  const auto camera = devices.camera();
  EXPECT_EQ(camera->state(), DeviceState::kStopped);
  EXPECT_FALSE(camera->read(milliseconds(100)));
  ASSERT_TRUE(camera->start());
  EXPECT_TRUE(camera->read(milliseconds(100)));
  EXPECT_EQ(camera->state(), DeviceState::kStreaming);
  camera->stop();
  EXPECT_EQ(camera->state(), DeviceState::kStopped);
}

TEST(SimulatedDevices, DeliverEverythingUntilTheEnd) {
  SimulatedDevices devices = made_devices(small_options(0.5));
  const auto camera = devices.camera();
  const auto lidar = devices.lidar();
  const auto trigger = devices.trigger_line();
  ASSERT_TRUE(camera->start() && lidar->start() && trigger->start());
  while (camera->state() != DeviceState::kEnded) camera->read(milliseconds(50));
  while (lidar->state() != DeviceState::kEnded) lidar->read(milliseconds(50));
  while (trigger->state() != DeviceState::kEnded) trigger->read(milliseconds(50));
  EXPECT_NEAR(static_cast<double>(camera->counters().frames), 15.0, 1.0);
  EXPECT_NEAR(static_cast<double>(lidar->counters().packets), 376.0, 2.0);
  EXPECT_GE(lidar->counters().positions, 26U);
  EXPECT_GE(trigger->counters().edges, 28U);
  EXPECT_EQ(lidar->counters().dropped, 0U);
}

TEST(SimulatedDevices, SayThatTheCameraIsGoneAndBack) {
  SimulationOptions options = small_options(1.0);
  options.faults.away = {{DeviceKind::kCamera, milliseconds(300), milliseconds(400)}};
  SimulatedDevices devices = made_devices(options);
  const auto camera = devices.camera();
  ASSERT_TRUE(camera->start());
  bool was_gone = false;
  while (camera->state() != DeviceState::kEnded) {
    if (!camera->read(milliseconds(50)) && camera->state() == DeviceState::kGone) was_gone = true;
  }
  EXPECT_TRUE(was_gone);
  EXPECT_EQ(camera->counters().restarts, 1U);
}

TEST(SimulatedDevices, CountWhatWasLost) {
  SimulationOptions options = small_options(1.0);
  options.faults.lost_frames = 0.2;
  options.faults.lost_edges = 0.1;
  SimulatedDevices devices = made_devices(options);
  const auto camera = devices.camera();
  const auto trigger = devices.trigger_line();
  ASSERT_TRUE(camera->start() && trigger->start());
  while (camera->state() != DeviceState::kEnded) camera->read(milliseconds(50));
  while (trigger->state() != DeviceState::kEnded) trigger->read(milliseconds(50));
  EXPECT_GT(camera->counters().lost, 0U);
  EXPECT_NEAR(static_cast<double>(camera->counters().frames + camera->counters().lost), 30.0, 2.0);
  EXPECT_GT(trigger->counters().repeated, 0U);
}

TEST(SimulatedDevices, ServeThreeThreads) {
  SimulatedDevices devices = made_devices(small_options(0.3));
  const auto camera = devices.camera();
  const auto lidar = devices.lidar();
  const auto trigger = devices.trigger_line();
  ASSERT_TRUE(camera->start() && lidar->start() && trigger->start());
  const auto drain = [](auto& device) {
    while (device.state() != DeviceState::kEnded) device.read(milliseconds(50));
  };
  std::thread frames([&] { drain(*camera); });
  std::thread packets([&] { drain(*lidar); });
  drain(*trigger);
  frames.join();
  packets.join();
  EXPECT_GE(camera->counters().frames, 8U);
  EXPECT_GE(lidar->counters().packets, 224U);
}

TEST(SimulatedDevices, KeepRealTimeWhenAsked) {
  SimulationOptions options = small_options(0.3);
  const auto now = std::chrono::steady_clock::now();
  options.start = HostTime{std::chrono::nanoseconds(now.time_since_epoch()) + milliseconds(200)};
  SimulatedDevices devices(std::make_unique<SimulatedRig>(options, bare_room()), options.start,
                           SimulatedPace::kRealTime);
  const auto trigger = devices.trigger_line();
  ASSERT_TRUE(trigger->start());
  while (trigger->state() != DeviceState::kEnded) {
    const std::optional<Edge> edge = trigger->read(milliseconds(20));
    if (!edge) continue;
    EXPECT_GE(std::chrono::steady_clock::now().time_since_epoch(), edge->time.time_since_epoch());
  }
  EXPECT_GE(trigger->counters().edges, 16U);
}

}  // namespace
}  // namespace sparsight
