#pragma once

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hal/calibration.h"
#include "hal/rig_event.h"
#include "tests/realtime/sync/made_camera.h"
#include "tests/realtime/sync/made_lidar.h"

namespace sparsight {

// Reads packets whose payload is the number of one that was decoded beforehand; a position
// packet's payload is the state of PPS.
class MadeDecoder final : public LidarDecoder {
 public:
  explicit MadeDecoder(std::shared_ptr<const std::vector<DecodedPacket>> packets)
      : packets_(std::move(packets)) {}

  bool decode(const LidarPacket& packet, DecodedPacket& out) override {
    std::uint32_t number = 0;
    std::memcpy(&number, packet.payload.data(), sizeof number);
    if (number >= packets_->size()) {
      ++counters_.refused;
      return false;
    }
    out = (*packets_)[number];
    ++counters_.decoded;
    return true;
  }
  std::optional<LidarClockReport> decode(const PositionPacket& packet) override {
    return LidarClockReport{.arrival = packet.arrival,
                            .pps = static_cast<PpsState>(packet.payload[0])};
  }
  DecoderCounters counters() const override { return counters_; }

 private:
  std::shared_ptr<const std::vector<DecodedPacket>> packets_;
  DecoderCounters counters_;
};

// A camera and a LiDAR side by side from host second 1000 on, with the truth of both.
class MadeRig {
 public:
  explicit MadeRig(const MadeCameraOptions& camera_options = {},
                   const MadeLidarOptions& lidar_options = {})
      : camera(camera_options), lidar(on_the_cameras_clock(lidar_options)) {}

  void run_lidar(std::chrono::nanoseconds duration, bool locked = false) {
    const SensorTime until = lidar.now() + duration;
    while (lidar.now() < until) {
      const SensorTime second(
          std::chrono::floor<std::chrono::seconds>(lidar.now().time_since_epoch()));
      if (locked && second != last_second_) {
        last_second_ = second;
        lidar_events_.emplace_back(lidar.pps(second));
        PositionPacket position{.arrival = lidar.host_time(lidar.now())};
        position.payload[0] = static_cast<std::uint8_t>(PpsState::kLocked);
        lidar_events_.emplace_back(position);
      }
      const auto number = static_cast<std::uint32_t>(packets_->size());
      packets_->push_back(lidar.next());
      LidarPacket packet{.arrival = packets_->back().arrival};
      std::memcpy(packet.payload.data(), &number, sizeof number);
      lidar_events_.emplace_back(packet);
    }
  }

  std::vector<RigEvent> events() const {
    std::vector<RigEvent> all = camera.events();
    all.insert(all.end(), lidar_events_.begin(), lidar_events_.end());
    std::stable_sort(all.begin(), all.end(), [](const RigEvent& a, const RigEvent& b) {
      return arrival_of(a) < arrival_of(b);
    });
    return all;
  }
  std::unique_ptr<LidarDecoder> decoder() const { return std::make_unique<MadeDecoder>(packets_); }

  // What MadeCamera's frames look like.
  static RigCalibration calibration() {
    RigCalibration rig;
    rig.camera = {.width = 4, .height = 2, .fx = 3.0, .fy = 3.0, .cx = 1.5, .cy = 0.5};
    rig.T_camera_lidar.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    return rig;
  }

  MadeCamera camera;
  MadeLidar lidar;

 private:
  static MadeLidarOptions on_the_cameras_clock(MadeLidarOptions options) {
    options.offset = std::chrono::seconds(1000) - MadeLidar::kHostStart;
    return options;
  }

  std::shared_ptr<std::vector<DecodedPacket>> packets_ =
      std::make_shared<std::vector<DecodedPacket>>();
  std::vector<RigEvent> lidar_events_;
  SensorTime last_second_{};
};

// The events of a made rig, one after the other.
class MadeEventSource final : public RigEventSource {
 public:
  explicit MadeEventSource(std::vector<RigEvent> events) : events_(std::move(events)) {}
  std::optional<RigEvent> next() override {
    return at_ < events_.size() ? std::optional(events_[at_++]) : std::nullopt;
  }

 private:
  std::vector<RigEvent> events_;
  std::size_t at_ = 0;
};

}  // namespace sparsight
