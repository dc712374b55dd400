#include "tools/playback/device_player.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "tests/drivers/replay/listed_events.h"
#include "tools/playback/playback_faults.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;

constexpr HostTime kFirst{std::chrono::seconds(1000)};

std::vector<RigEvent> short_recording() {
  std::vector<RigEvent> events;
  for (int i = 0; i < 10; ++i) {
    const HostTime at = kFirst + i * 5ms;
    events.push_back(Edge{EdgeLine::kExposure, i % 2 == 0, at});
    events.push_back(LidarPacket{.arrival = at + 1ms});
    auto frame = std::make_shared<CameraFrame>();
    frame->arrival = at + 2ms;
    events.push_back(std::shared_ptr<const CameraFrame>(std::move(frame)));
    events.push_back(DeviceStateChange{DeviceKind::kLidar, DeviceState::kSilent, at + 3ms});
  }
  return events;
}

struct Written {
  RigEvent event;
  HostTime due;
  HostTime when;
};

// Three devices that keep what is written to them.
struct Devices {
  std::mutex mutex;
  std::vector<Written> written;
  int status = 0;

  DevicePlayer::Devices all(std::size_t events_ahead) {
    DevicePlayer::Devices devices;
    for (PlayedDevice& device : devices) {
      device.name = "played";
      device.events_ahead = events_ahead;
      device.write = [this](const RigEvent& event, HostTime due) {
        const std::lock_guard lock(mutex);
        written.push_back({event, due, HostClock::now()});
        return status;
      };
    }
    return devices;
  }
};

TEST(DevicePlayer, WritesEachEventWhenItArrivedInTheRecording) {
  Devices devices;
  DevicePlayer player(devices.all(64));
  ListedEvents events(short_recording());
  const HostTime begun = HostClock::now();
  player.play(events, {.first = kFirst, .lead = 20ms});
  ASSERT_EQ(devices.written.size(), 30U) << "states are no device's data";
  EXPECT_GE(player.moved_by(), begun + 20ms - kFirst);
  for (const Written& written : devices.written) {
    EXPECT_EQ(written.due, arrival_of(written.event) + player.moved_by());
    EXPECT_GE(written.when, written.due) << "never early";
  }
  for (const auto device : {DeviceKind::kCamera, DeviceKind::kLidar, DeviceKind::kTrigger}) {
    EXPECT_EQ(player.counts(device).played, 10U);
    EXPECT_EQ(player.counts(device).refused, 0U);
  }
}

TEST(DevicePlayer, KeepsTheOrderOfADeviceWhoseQueueIsShort) {
  Devices devices;
  DevicePlayer player(devices.all(2));
  ListedEvents events(short_recording());
  player.play(events, {.first = kFirst});
  ASSERT_EQ(devices.written.size(), 30U);
  std::array<HostTime, 3> last{};
  for (const Written& written : devices.written) {
    HostTime& before = last[static_cast<std::size_t>(device_of(written.event))];
    EXPECT_GT(written.due, before);
    before = written.due;
  }
}

TEST(DevicePlayer, CountsWhatIsWithheldAndWhatADeviceRefuses) {
  Devices devices;
  devices.status = -EAGAIN;
  DevicePlayer player(devices.all(64));
  ListedEvents events(short_recording());
  player.play(
      events,
      {.withhold = [](const RigEvent& event) { return device_of(event) == DeviceKind::kLidar; },
       .first = kFirst});
  EXPECT_EQ(player.counts(DeviceKind::kLidar).withheld, 10U);
  EXPECT_EQ(player.counts(DeviceKind::kLidar).refused, 0U);
  EXPECT_EQ(player.counts(DeviceKind::kCamera).played, 0U);
  EXPECT_EQ(player.counts(DeviceKind::kCamera).refused, 10U);
  EXPECT_EQ(player.counts(DeviceKind::kCamera).last_errno, EAGAIN);
}

TEST(DevicePlayer, EndsWhenItIsAskedTo) {
  Devices devices;
  DevicePlayer player(devices.all(64));
  ListedEvents events(short_recording());
  player.play(events, {.first = kFirst, .stop = [] { return true; }});
  EXPECT_TRUE(devices.written.size() <= 3) << "those that were being waited for";
}

TEST(PlaybackFaults, LoseWholeExposuresTheSameOnesEachTime) {
  const SimulatedFaults faults{.lost_edges = 0.3};
  PlaybackFaults once(faults, kFirst, 1);
  PlaybackFaults again(faults, kFirst, 1);
  int lost = 0;
  for (int i = 0; i < 1000; ++i) {
    const HostTime at = kFirst + i * 33ms;
    const bool rising = once.withhold(Edge{EdgeLine::kExposure, true, at});
    EXPECT_EQ(once.withhold(Edge{EdgeLine::kExposure, false, at + 4ms}), rising);
    EXPECT_EQ(again.withhold(Edge{EdgeLine::kExposure, true, at}), rising);
    EXPECT_FALSE(once.withhold(Edge{EdgeLine::kPps, true, at}));
    lost += rising ? 1 : 0;
  }
  EXPECT_NEAR(lost, 300, 60);
}

TEST(PlaybackFaults, KeepADeviceAwayForItsTime) {
  SimulatedFaults faults;
  faults.away.push_back({DeviceKind::kLidar, 2s, 1s});
  PlaybackFaults playback(faults, kFirst, 1);
  EXPECT_FALSE(playback.withhold(LidarPacket{.arrival = kFirst + 1999ms}));
  EXPECT_TRUE(playback.withhold(LidarPacket{.arrival = kFirst + 2s}));
  EXPECT_TRUE(playback.withhold(PositionPacket{.arrival = kFirst + 2999ms}));
  EXPECT_FALSE(playback.withhold(LidarPacket{.arrival = kFirst + 3s}));
  EXPECT_FALSE(playback.withhold(Edge{EdgeLine::kExposure, true, kFirst + 2s}));
}

}  // namespace
}  // namespace sparsight
