#include "realtime/pipeline/device_stage.h"

#include <chrono>
#include <thread>
#include <utility>
#include <variant>

namespace sparsight {
namespace {

using namespace std::chrono_literals;

// How long a device is waited for before the thread looks around; three periods of the camera.
constexpr auto kDevicePatience = 100ms;
constexpr int kRoundsToRetry = 10;  // of kDevicePatience

void count(std::atomic<std::uint64_t>& counter) { counter.fetch_add(1, std::memory_order_relaxed); }

std::uint64_t lost_by(const CameraCounters& counters) { return counters.lost; }
std::uint64_t lost_by(const LidarCounters& counters) { return counters.dropped; }
std::uint64_t lost_by(const TriggerCounters& counters) { return counters.repeated; }

template <typename D, typename Read>
DeviceStage::Device stage_device_of(std::shared_ptr<D> device, DeviceKind kind, Read read) {
  return {.kind = kind,
          .start = [device] { return device->start(); },
          .read = [device, read]() -> std::optional<RigEvent> { return read(*device); },
          .stop = [device] { device->stop(); },
          .state = [device] { return device->state(); },
          .lost = [device] { return lost_by(device->counters()); }};
}

}  // namespace

DeviceStage::DeviceStage(Device device, std::size_t queue_events, ThreadSettings settings,
                         SetupRemarks& remarks)
    : device_(std::move(device)),
      to_sync_(queue_events),
      to_recorder_(queue_events),
      thread_(std::move(settings), remarks) {}

void DeviceStage::start() {
  thread_.start([this] { run(); });
}

void DeviceStage::run() {
  bool started = begin();
  for (int rounds = 0; !thread_.stopping(); thread_.beat()) {
    if (!started) {
      std::this_thread::sleep_for(kDevicePatience);
      if (++rounds % kRoundsToRetry == 0) started = begin();
      continue;
    }
    if (const std::optional<RigEvent> event = device_.read()) put(*event);
    if (device_.lost) lost_.store(device_.lost(), std::memory_order_relaxed);
    note(device_.state());
    if (state_ == DeviceState::kEnded) break;
  }
  device_.stop();
  if (state_ != DeviceState::kEnded) note(DeviceState::kStopped);
}

bool DeviceStage::begin() {
  const Result<void> started = device_.start();
  say(started ? "" : started.error().message);
  note(started ? device_.state() : DeviceState::kGone);
  return started.has_value();
}

void DeviceStage::put(const RigEvent& event) {
  count(events_);
  if (!to_recorder_.producer().try_push(event)) count(not_recorded_);
  if (!to_sync_.producer().try_push(event)) count(not_synchronized_);
}

void DeviceStage::note(DeviceState state) {
  if (state_.exchange(state) == state) return;
  if (state == DeviceState::kEnded) return;
  if (state == DeviceState::kStreaming && device_.streams) device_.streams();
  const DeviceStateChange change{.device = device_.kind, .state = state, .at = HostClock::now()};
  to_recorder_.producer().try_push(change);
  to_sync_.producer().try_push(change);
}

void DeviceStage::say(const std::string& message) {
  const std::lock_guard lock(mutex_);
  message_ = message;
}

DeviceStatus DeviceStage::status() const {
  DeviceStatus status{.state = state_.load(),
                      .events = events_.load(std::memory_order_relaxed),
                      .lost = lost_.load(std::memory_order_relaxed),
                      .not_synchronized = not_synchronized_.load(std::memory_order_relaxed),
                      .not_recorded = not_recorded_.load(std::memory_order_relaxed)};
  const std::lock_guard lock(mutex_);
  status.message = message_;
  return status;
}

DeviceStage::Device stage_device(std::shared_ptr<Camera> camera) {
  return stage_device_of(std::move(camera), DeviceKind::kCamera,
                         [](Camera& device) -> std::optional<RigEvent> {
                           auto frame = device.read(kDevicePatience);
                           if (!frame) return std::nullopt;
                           return std::make_shared<const CameraFrame>(std::move(*frame));
                         });
}

DeviceStage::Device stage_device(std::shared_ptr<Lidar> lidar) {
  return stage_device_of(
      std::move(lidar), DeviceKind::kLidar, [](Lidar& device) -> std::optional<RigEvent> {
        const auto message = device.read(kDevicePatience);
        if (!message) return std::nullopt;
        return std::visit([](const auto& packet) { return RigEvent(packet); }, *message);
      });
}

DeviceStage::Device stage_device(std::shared_ptr<TriggerLine> line) {
  return stage_device_of(std::move(line), DeviceKind::kTrigger,
                         [](TriggerLine& device) -> std::optional<RigEvent> {
                           const auto edge = device.read(kDevicePatience);
                           if (!edge) return std::nullopt;
                           return RigEvent(*edge);
                         });
}

}  // namespace sparsight
