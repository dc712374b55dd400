#include "drivers/simulated/simulated_devices.h"

#include <utility>
#include <variant>

#include "drivers/simulated/event_hub.h"

namespace sparsight {
namespace {

using simulated::EventHub;

class SimulatedCamera : public Camera {
 public:
  explicit SimulatedCamera(std::shared_ptr<EventHub> hub) : hub_(std::move(hub)) {}
  ~SimulatedCamera() override { hub_->stop(DeviceKind::kCamera); }

  Result<void> start() override {
    hub_->start(DeviceKind::kCamera);
    return {};
  }
  std::optional<CameraFrame> read(std::chrono::nanoseconds patience) override {
    const std::optional<RigEvent> event = hub_->read(DeviceKind::kCamera, patience);
    if (!event) return std::nullopt;
    CameraFrame frame = *std::get<std::shared_ptr<const CameraFrame>>(*event);
    count(frame);
    return frame;
  }
  void stop() override { hub_->stop(DeviceKind::kCamera); }
  DeviceState state() const override { return hub_->state(DeviceKind::kCamera); }
  CameraCounters counters() const override { return counters_; }

 private:
  void count(const CameraFrame& frame) {
    if (counters_.frames++ == 0) {
      epoch_ = frame.epoch;
      expected_ = frame.sequence;
    }
    if (frame.epoch != epoch_) {
      ++counters_.restarts;
      epoch_ = frame.epoch;
      expected_ = 0;
    }
    counters_.lost += frame.sequence - expected_;
    expected_ = frame.sequence + 1;
  }

  std::shared_ptr<EventHub> hub_;
  CameraCounters counters_;
  std::uint32_t epoch_ = 0;
  std::uint32_t expected_ = 0;
};

class SimulatedLidar : public Lidar {
 public:
  explicit SimulatedLidar(std::shared_ptr<EventHub> hub) : hub_(std::move(hub)) {}
  ~SimulatedLidar() override { hub_->stop(DeviceKind::kLidar); }

  Result<void> start() override {
    hub_->start(DeviceKind::kLidar);
    return {};
  }
  std::optional<LidarMessage> read(std::chrono::nanoseconds patience) override {
    const std::optional<RigEvent> event = hub_->read(DeviceKind::kLidar, patience);
    if (!event) return std::nullopt;
    if (const auto* packet = std::get_if<LidarPacket>(&*event)) {
      ++counters_.packets;
      return *packet;
    }
    ++counters_.positions;
    return std::get<PositionPacket>(*event);
  }
  void stop() override { hub_->stop(DeviceKind::kLidar); }
  DeviceState state() const override { return hub_->state(DeviceKind::kLidar); }
  LidarCounters counters() const override {
    LidarCounters counters = counters_;
    counters.dropped = hub_->dropped(DeviceKind::kLidar);
    return counters;
  }

 private:
  std::shared_ptr<EventHub> hub_;
  LidarCounters counters_;
};

class SimulatedTriggerLine : public TriggerLine {
 public:
  explicit SimulatedTriggerLine(std::shared_ptr<EventHub> hub) : hub_(std::move(hub)) {}
  ~SimulatedTriggerLine() override { hub_->stop(DeviceKind::kTrigger); }

  Result<void> start() override {
    hub_->start(DeviceKind::kTrigger);
    return {};
  }
  std::optional<Edge> read(std::chrono::nanoseconds patience) override {
    const std::optional<RigEvent> event = hub_->read(DeviceKind::kTrigger, patience);
    if (!event) return std::nullopt;
    const Edge edge = std::get<Edge>(*event);
    ++counters_.edges;
    std::optional<bool>& last = edge.line == EdgeLine::kExposure ? last_exposure_ : last_pps_;
    if (last == edge.rising) ++counters_.repeated;
    last = edge.rising;
    return edge;
  }
  void stop() override { hub_->stop(DeviceKind::kTrigger); }
  DeviceState state() const override { return hub_->state(DeviceKind::kTrigger); }
  TriggerCounters counters() const override { return counters_; }

 private:
  std::shared_ptr<EventHub> hub_;
  TriggerCounters counters_;
  std::optional<bool> last_exposure_;
  std::optional<bool> last_pps_;
};

}  // namespace

SimulatedDevices::SimulatedDevices(std::unique_ptr<RigEventSource> rig, HostTime start,
                                   SimulatedPace pace)
    : hub_(std::make_shared<EventHub>(std::move(rig), start, pace)) {}

std::unique_ptr<Camera> SimulatedDevices::camera() {
  return std::make_unique<SimulatedCamera>(hub_);
}

std::unique_ptr<Lidar> SimulatedDevices::lidar() { return std::make_unique<SimulatedLidar>(hub_); }

std::unique_ptr<TriggerLine> SimulatedDevices::trigger_line() {
  return std::make_unique<SimulatedTriggerLine>(hub_);
}

}  // namespace sparsight
