#include "drivers/replay/played_events.h"

#include <utility>
#include <variant>

namespace sparsight {
namespace {

struct Moved {
  std::chrono::nanoseconds by;
  std::uint32_t restarts;

  RigEvent operator()(const std::shared_ptr<const CameraFrame>& frame) const {
    auto later = std::make_shared<CameraFrame>(*frame);
    later->arrival += by;
    later->driver_time += by;
    later->epoch += restarts;
    return std::shared_ptr<const CameraFrame>(std::move(later));
  }
  RigEvent operator()(Edge edge) const {
    edge.time += by;
    return edge;
  }
  RigEvent operator()(LidarPacket packet) const {
    packet.arrival += by;
    return packet;
  }
  RigEvent operator()(PositionPacket packet) const {
    packet.arrival += by;
    return packet;
  }
  RigEvent operator()(DeviceStateChange change) const {
    change.at += by;
    return change;
  }
};

}  // namespace

RigEvent moved(const RigEvent& event, std::chrono::nanoseconds by, std::uint32_t restarts) {
  return std::visit(Moved{by, restarts}, event);
}

PlayedEvents::PlayedEvents(std::unique_ptr<RigEventSource> events, std::chrono::nanoseconds by,
                           std::size_t ahead)
    : events_(std::move(events)), by_(by), ahead_(ahead), thread_([this] { run(); }) {}

PlayedEvents::~PlayedEvents() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::optional<RigEvent> PlayedEvents::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !waiting_.empty() || ended_; });
  if (waiting_.empty()) return std::nullopt;
  std::optional<RigEvent> event(std::move(waiting_.front()));
  waiting_.pop_front();
  lock.unlock();
  changed_.notify_all();
  return event;
}

void PlayedEvents::run() {
  for (;;) {
    const std::optional<RigEvent> event = events_->next();
    std::optional<RigEvent> later;
    if (event) later = moved(*event, by_);
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.size() < ahead_ || stopping_; });
    if (stopping_) return;
    if (later) waiting_.push_back(std::move(*later));
    ended_ = !later;
    lock.unlock();
    changed_.notify_all();
    if (!later) return;
  }
}

}  // namespace sparsight
