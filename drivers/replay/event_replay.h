#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "hal/result.h"
#include "hal/rig_event.h"

namespace sparsight {

// Opens a recording or a simulated rig at its beginning.
using OpenEvents = std::function<Result<std::unique_ptr<RigEventSource>>()>;

// The events of one device out of a rig's, as fast as they are asked for. Thread-bound.
class EventReplay {
 public:
  EventReplay(OpenEvents open, DeviceKind device) : open_(std::move(open)), device_(device) {}

  // Starting again begins at the beginning.
  Result<void> start();
  void stop();
  DeviceState state() const { return state_; }

  // The next event of type Event; nothing when stopped or at the end. What became of the device on
  // the way is its state from then on.
  template <typename Event>
  std::optional<Event> next() {
    while (auto event = next_event()) {
      if (const Event* wanted = std::get_if<Event>(&*event)) return *wanted;
    }
    return std::nullopt;
  }
  template <typename Event, typename Other>
  std::optional<std::variant<Event, Other>> next_of_two() {
    while (auto event = next_event()) {
      if (const Event* wanted = std::get_if<Event>(&*event)) return *wanted;
      if (const Other* wanted = std::get_if<Other>(&*event)) return *wanted;
    }
    return std::nullopt;
  }

 private:
  std::optional<RigEvent> next_event();

  OpenEvents open_;
  DeviceKind device_;
  std::unique_ptr<RigEventSource> events_;
  DeviceState state_ = DeviceState::kStopped;
};

}  // namespace sparsight
