#include "drivers/replay/replayed_devices.h"

#include "tests/contract/device_under_test.h"

// The devices of a rig's events, here of some made in memory.
namespace sparsight::contract {
namespace {

using namespace std::chrono_literals;

RigEvent made_frame(int i, HostTime arrival) {
  auto frame = std::make_shared<CameraFrame>();
  frame->sequence = static_cast<std::uint32_t>(i < 20 ? i + (i > 7 ? 2 : 0) : i - 20);
  frame->epoch = i < 20 ? 0 : 1;
  frame->driver_time = arrival - 5ms;
  frame->arrival = arrival;
  frame->damaged = i == 4;
  frame->width = 8;
  frame->height = 2;
  frame->stride_bytes = 8;
  frame->bytes.assign(16, static_cast<std::uint8_t>(i));
  return std::shared_ptr<const CameraFrame>(std::move(frame));
}

class MadeEvents final : public RigEventSource {
 public:
  std::optional<RigEvent> next() override {
    if (next_ >= 400) return std::nullopt;
    const int i = next_++;
    const HostTime time(1s + i * 3ms);
    switch (i % 10) {
      case 0:
        return Edge{.line = EdgeLine::kExposure, .rising = true, .time = time};
      case 1:
        return Edge{.line = EdgeLine::kExposure, .rising = false, .time = time};
      case 2:
        return made_frame(i / 10, time);
      case 3:
        return PositionPacket{.arrival = time};
      case 4:
        if (i == 204) return DeviceStateChange{DeviceKind::kLidar, DeviceState::kStreaming, time};
        if (i == 394) return DeviceStateChange{DeviceKind::kCamera, DeviceState::kStopped, time};
        [[fallthrough]];
      default:
        return LidarPacket{.arrival = time};
    }
  }

 private:
  int next_ = 0;
};

Result<std::unique_ptr<RigEventSource>> open_made_events() {
  return std::make_unique<MadeEvents>();
}

const bool kEventsAdded = add_event_source({"Made", [] { return std::make_unique<MadeEvents>(); }});
const bool kCameraAdded = add_camera(
    {"Replayed",
     [] { return CameraUnderTest{.device = std::make_unique<ReplayedCamera>(open_made_events)}; },
     DeviceNature::kReplayed});
const bool kLidarAdded = add_lidar(
    {"Replayed",
     [] { return LidarUnderTest{.device = std::make_unique<ReplayedLidar>(open_made_events)}; },
     DeviceNature::kReplayed});
const bool kTriggerLineAdded =
    add_trigger_line({"Replayed",
                      [] {
                        return TriggerLineUnderTest{
                            .device = std::make_unique<ReplayedTriggerLine>(open_made_events)};
                      },
                      DeviceNature::kReplayed});

}  // namespace
}  // namespace sparsight::contract
