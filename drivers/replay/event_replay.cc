#include "drivers/replay/event_replay.h"

namespace sparsight {

Result<void> EventReplay::start() {
  if (state_ != DeviceState::kStopped) return {};
  auto events = open_();
  if (!events) return tl::unexpected(events.error());
  events_ = std::move(*events);
  state_ = DeviceState::kStreaming;
  return {};
}

void EventReplay::stop() {
  events_.reset();
  state_ = DeviceState::kStopped;
}

std::optional<RigEvent> EventReplay::next_event() {
  if (!events_) return std::nullopt;
  auto event = events_->next();
  if (!event) {
    events_.reset();
    state_ = DeviceState::kEnded;
    return event;
  }
  // That it was stopped when it was recorded is no matter of this replay.
  const auto* change = std::get_if<DeviceStateChange>(&*event);
  if (change && change->device == device_ && change->state != DeviceState::kStopped &&
      change->state != DeviceState::kEnded) {
    state_ = change->state;
  }
  return event;
}

}  // namespace sparsight
