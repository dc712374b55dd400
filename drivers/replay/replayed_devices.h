#pragma once

#include "drivers/replay/event_replay.h"
#include "hal/camera.h"
#include "hal/lidar.h"
#include "hal/trigger_line.h"

namespace sparsight {

// The devices of a recording or of a simulated rig, each behind the interface of the live one. They
// never wait: what comes next is there, or the end is.

class ReplayedCamera final : public Camera {
 public:
  explicit ReplayedCamera(OpenEvents open) : replay_(std::move(open), DeviceKind::kCamera) {}
  Result<void> start() override { return replay_.start(); }
  std::optional<CameraFrame> read(std::chrono::nanoseconds patience) override;
  void stop() override { replay_.stop(); }
  DeviceState state() const override { return replay_.state(); }
  CameraCounters counters() const override { return counters_; }

 private:
  void count(const CameraFrame& frame);

  EventReplay replay_;
  CameraCounters counters_;
  std::optional<std::uint32_t> last_sequence_;
  std::uint32_t last_epoch_ = 0;
};

class ReplayedLidar final : public Lidar {
 public:
  explicit ReplayedLidar(OpenEvents open) : replay_(std::move(open), DeviceKind::kLidar) {}
  Result<void> start() override { return replay_.start(); }
  std::optional<LidarMessage> read(std::chrono::nanoseconds patience) override;
  void stop() override { replay_.stop(); }
  DeviceState state() const override { return replay_.state(); }
  LidarCounters counters() const override { return counters_; }

 private:
  EventReplay replay_;
  LidarCounters counters_;
};

class ReplayedTriggerLine final : public TriggerLine {
 public:
  explicit ReplayedTriggerLine(OpenEvents open) : replay_(std::move(open), DeviceKind::kTrigger) {}
  Result<void> start() override { return replay_.start(); }
  std::optional<Edge> read(std::chrono::nanoseconds patience) override;
  void stop() override { replay_.stop(); }
  DeviceState state() const override { return replay_.state(); }
  TriggerCounters counters() const override { return counters_; }

 private:
  EventReplay replay_;
  TriggerCounters counters_;
};

}  // namespace sparsight
