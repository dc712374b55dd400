#include "drivers/simulated/event_hub.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>
#include <variant>

namespace sparsight::simulated {
namespace {

// About five seconds of frames, of packets, of edges.
constexpr std::array<std::size_t, 3> kMostWaiting{150, 4096, 512};

struct DeviceOf {
  DeviceKind operator()(const std::shared_ptr<const CameraFrame>&) const {
    return DeviceKind::kCamera;
  }
  DeviceKind operator()(const Edge&) const { return DeviceKind::kTrigger; }
  DeviceKind operator()(const LidarPacket&) const { return DeviceKind::kLidar; }
  DeviceKind operator()(const PositionPacket&) const { return DeviceKind::kLidar; }
  DeviceKind operator()(const DeviceStateChange& change) const { return change.device; }
};

HostTime clock_now() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return HostTime{std::chrono::duration_cast<std::chrono::nanoseconds>(now)};
}

void sleep_until(HostTime at) {
  std::this_thread::sleep_until(std::chrono::steady_clock::time_point(at.time_since_epoch()));
}

}  // namespace

EventHub::EventHub(std::unique_ptr<RigEventSource> source, HostTime start, SimulatedPace pace)
    : source_(std::move(source)), pace_(pace) {
  for (Reader& reader : readers_) reader.now = start;
}

void EventHub::start(DeviceKind device) {
  const std::lock_guard lock(mutex_);
  reader(device).running = true;
}

void EventHub::stop(DeviceKind device) {
  const std::lock_guard lock(mutex_);
  reader(device).running = false;
  reader(device).waiting.clear();
}

// The next event of the source goes to its device.
bool EventHub::fetch() {
  std::optional<RigEvent> event = source_->next();
  if (!event) {
    source_ended_ = true;
    return false;
  }
  const DeviceKind device = std::visit(DeviceOf{}, *event);
  Reader& owner = reader(device);
  if (!owner.running) {
    if (const auto* change = std::get_if<DeviceStateChange>(&*event)) {
      owner.gone = change->state == DeviceState::kGone;
    }
    return true;
  }
  owner.waiting.push_back(std::move(*event));
  if (owner.waiting.size() > kMostWaiting[static_cast<std::size_t>(device)]) {
    owner.waiting.pop_front();
    ++owner.dropped;
  }
  return true;
}

HostTime EventHub::limit_of(const Reader& reader, std::chrono::nanoseconds patience) const {
  return (pace_ == SimulatedPace::kRealTime ? clock_now() : reader.now) + patience;
}

std::optional<RigEvent> EventHub::first_until(Reader& reader, HostTime limit) {
  while (true) {
    while (reader.waiting.empty() && fetch()) {
    }
    if (reader.waiting.empty()) {
      reader.ended = true;
      return std::nullopt;
    }
    if (arrival_of(reader.waiting.front()) > limit) return std::nullopt;
    RigEvent event = std::move(reader.waiting.front());
    reader.waiting.pop_front();
    const auto* change = std::get_if<DeviceStateChange>(&event);
    if (change == nullptr) return event;
    reader.gone = change->state == DeviceState::kGone;
  }
}

std::optional<RigEvent> EventHub::read(DeviceKind device, std::chrono::nanoseconds patience) {
  std::optional<RigEvent> event;
  HostTime due;
  {
    const std::lock_guard lock(mutex_);
    Reader& owner = reader(device);
    if (!owner.running || owner.ended) return std::nullopt;
    const HostTime limit = limit_of(owner, patience);
    event = first_until(owner, limit);
    owner.silent = !event;
    due = event ? arrival_of(*event) : limit;
    owner.now = std::max(owner.now, due);
    if (owner.ended) return std::nullopt;
  }
  if (pace_ == SimulatedPace::kRealTime) sleep_until(due);
  return event;
}

DeviceState EventHub::state(DeviceKind device) const {
  const std::lock_guard lock(mutex_);
  const Reader& owner = reader(device);
  if (!owner.running) return DeviceState::kStopped;
  if (owner.ended) return DeviceState::kEnded;
  if (owner.gone) return DeviceState::kGone;
  return owner.silent ? DeviceState::kSilent : DeviceState::kStreaming;
}

std::uint64_t EventHub::dropped(DeviceKind device) const {
  const std::lock_guard lock(mutex_);
  return reader(device).dropped;
}

}  // namespace sparsight::simulated
