#pragma once

#include <chrono>
#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "hal/rig_event.h"
#include "realtime/executor/loop_clock.h"
#include "realtime/pipeline/live_pipeline.h"
#include "tests/realtime/sync/made_rig.h"
#include "tests/slam/room_rig.h"

namespace sparsight {

// The room rig as its devices would deliver it: frames, edges and packets of a short walk.
class MadeWalk {
 public:
  static constexpr std::chrono::nanoseconds kPeriod{33'333'333};
  static constexpr std::chrono::nanoseconds kExposure{4'000'000};
  static constexpr std::chrono::nanoseconds kTransfer{9'000'000};

  explicit MadeWalk(int frames) {
    add_packets(frames * kPeriod);
    for (int i = 0; i < frames; ++i) add_frame(i);
  }

  // As if it had begun then: to render it takes longer than to walk it, under a sanitizer.
  void begin_at(HostTime start) {
    const std::chrono::nanoseconds by = start - start_;
    start_ = start;
    for (RigEvent& event : edges_) std::get<Edge>(event).time += by;
    for (RigEvent& event : packet_events_) std::get<LidarPacket>(event).arrival += by;
    for (DecodedPacket& packet : *packets_) packet.arrival += by;
    for (RigEvent& event : frames_) {
      auto& frame = std::get<std::shared_ptr<const CameraFrame>>(event);
      auto moved = std::make_shared<CameraFrame>(*frame);
      moved->driver_time += by;
      moved->arrival += by;
      frame = std::move(moved);
    }
  }

  RigCalibration calibration() const { return rig_.calibration(); }
  Eigen::Isometry3d T_world_camera(HostTime at) const {
    return rig_.T_world_camera_at(to_seconds(at - start_));
  }
  std::unique_ptr<LidarDecoder> decoder() const { return std::make_unique<MadeDecoder>(packets_); }

  std::vector<RigEvent> events() const {
    std::vector<RigEvent> all = frames_;
    all.insert(all.end(), edges_.begin(), edges_.end());
    all.insert(all.end(), packet_events_.begin(), packet_events_.end());
    std::stable_sort(all.begin(), all.end(), [](const RigEvent& a, const RigEvent& b) {
      return arrival_of(a) < arrival_of(b);
    });
    return all;
  }
  const std::vector<RigEvent>& frames() const { return frames_; }
  const std::vector<RigEvent>& edges() const { return edges_; }
  const std::vector<RigEvent>& packets() const { return packet_events_; }

 private:
  void add_frame(int i) {
    const HostTime rise = start_ + std::chrono::milliseconds(120) + i * kPeriod;
    edges_.emplace_back(Edge{EdgeLine::kExposure, true, rise});
    edges_.emplace_back(Edge{EdgeLine::kExposure, false, rise + kExposure});
    const GreyImage image = rig_.room.image(T_world_camera(rise + kExposure / 2));
    auto frame = std::make_shared<CameraFrame>();
    frame->sequence = static_cast<std::uint32_t>(i);
    frame->driver_time = rise + kExposure + kTransfer;
    frame->arrival = frame->driver_time + std::chrono::microseconds(50);
    frame->width = frame->stride_bytes = image.width;
    frame->height = image.height;
    frame->bytes = image.pixels;
    frames_.emplace_back(std::shared_ptr<const CameraFrame>(std::move(frame)));
  }

  // A VLP-16's packets; its returns are cast from where the rig was.
  void add_packets(std::chrono::nanoseconds duration) {
    MadeLidar lidar({.offset = start_.time_since_epoch() - MadeLidar::kHostStart});
    const SensorTime until = lidar.now() + duration + std::chrono::milliseconds(200);
    while (lidar.now() < until) {
      DecodedPacket packet = lidar.next();
      const Eigen::Isometry3d T_world_lidar =
          T_world_camera(lidar.host_time(packet.first_firing)) * rig_.T_camera_lidar;
      for (TimedReturn& r : packet.returns) place(T_world_lidar, r);
      const auto number = static_cast<std::uint32_t>(packets_->size());
      LidarPacket raw{.arrival = packet.arrival};
      std::memcpy(raw.payload.data(), &number, sizeof number);
      packets_->push_back(std::move(packet));
      packet_events_.emplace_back(raw);
    }
  }
  void place(const Eigen::Isometry3d& T_world_lidar, TimedReturn& r) const {
    const double azimuth = -static_cast<double>(r.azimuth_deg) * M_PI / 180.0;
    const double elevation = (2.0 * r.ring - 15.0) * M_PI / 180.0;
    const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                              std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
    r.p_lidar = (T_world_lidar.inverse() *
                 rig_.room.wall_along(T_world_lidar.translation(), T_world_lidar.linear() * ray))
                    .cast<float>();
    r.intensity = 20.0F;
  }

  RoomRig rig_;
  HostTime start_{std::chrono::seconds(1000)};
  std::vector<RigEvent> frames_;
  std::vector<RigEvent> edges_;
  std::vector<RigEvent> packet_events_;
  std::shared_ptr<std::vector<DecodedPacket>> packets_ =
      std::make_shared<std::vector<DecodedPacket>>();
};

// One device's events, each there when the clock has reached its arrival.
class PlayedDevice {
 public:
  explicit PlayedDevice(std::vector<RigEvent> events) : events_(std::move(events)) {}

  std::optional<RigEvent> read(std::chrono::nanoseconds patience) {
    MonotonicClock clock;
    const HostTime limit = clock.now() + patience;
    if (at_ == events_.size()) return std::nullopt;
    const HostTime arrival = arrival_of(events_[at_]);
    clock.sleep_until(std::min(arrival, limit));
    return arrival > limit ? std::nullopt : std::optional(events_[at_++]);
  }
  DeviceState state() const {
    return at_ == events_.size() ? DeviceState::kEnded : DeviceState::kStreaming;
  }

 private:
  std::vector<RigEvent> events_;
  std::size_t at_ = 0;
};

class PlayedCamera : public Camera {
 public:
  explicit PlayedCamera(std::vector<RigEvent> events) : played_(std::move(events)) {}
  Result<void> start() override { return {}; }
  std::optional<CameraFrame> read(std::chrono::nanoseconds patience) override {
    const auto event = played_.read(patience);
    if (!event) return std::nullopt;
    return *std::get<std::shared_ptr<const CameraFrame>>(*event);
  }
  void stop() override {}
  DeviceState state() const override { return played_.state(); }
  CameraCounters counters() const override { return {}; }

 private:
  PlayedDevice played_;
};

class PlayedLidar : public Lidar {
 public:
  explicit PlayedLidar(std::vector<RigEvent> events) : played_(std::move(events)) {}
  Result<void> start() override { return {}; }
  std::optional<LidarMessage> read(std::chrono::nanoseconds patience) override {
    const auto event = played_.read(patience);
    if (!event) return std::nullopt;
    return std::get<LidarPacket>(*event);
  }
  void stop() override {}
  DeviceState state() const override { return played_.state(); }
  LidarCounters counters() const override { return {}; }

 private:
  PlayedDevice played_;
};

class PlayedTrigger final : public TriggerLine {
 public:
  explicit PlayedTrigger(std::vector<RigEvent> events) : played_(std::move(events)) {}
  Result<void> start() override { return {}; }
  std::optional<Edge> read(std::chrono::nanoseconds patience) override {
    const auto event = played_.read(patience);
    if (!event) return std::nullopt;
    return std::get<Edge>(*event);
  }
  void stop() override {}
  DeviceState state() const override { return played_.state(); }
  TriggerCounters counters() const override { return {}; }

 private:
  PlayedDevice played_;
};

inline LiveDevices played_devices(const MadeWalk& walk) {
  LiveDevices devices;
  devices.camera = std::make_shared<PlayedCamera>(walk.frames());
  devices.lidar = std::make_shared<PlayedLidar>(walk.packets());
  devices.trigger = std::make_shared<PlayedTrigger>(walk.edges());
  devices.decoder = walk.decoder();
  return devices;
}

}  // namespace sparsight
