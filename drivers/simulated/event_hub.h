#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>

#include "drivers/simulated/simulated_devices.h"
#include "hal/rig_event.h"

namespace sparsight::simulated {

// Deals the events of one source out to three readers. Thread-safe.
class EventHub {
 public:
  EventHub(std::unique_ptr<RigEventSource> source, HostTime start, SimulatedPace pace);

  void start(DeviceKind device);
  void stop(DeviceKind device);
  // The device's next event if it arrives within `patience` of what was read before; the device's
  // time moves on by as much otherwise.
  std::optional<RigEvent> read(DeviceKind device, std::chrono::nanoseconds patience);
  DeviceState state(DeviceKind device) const;
  std::uint64_t dropped(DeviceKind device) const;

 private:
  struct Reader {
    bool running = false;
    bool gone = false;
    bool silent = false;
    bool ended = false;
    HostTime now;
    std::deque<RigEvent> waiting;
    std::uint64_t dropped = 0;
  };

  Reader& reader(DeviceKind device) { return readers_[static_cast<std::size_t>(device)]; }
  const Reader& reader(DeviceKind device) const {
    return readers_[static_cast<std::size_t>(device)];
  }
  bool fetch();
  HostTime limit_of(const Reader& reader, std::chrono::nanoseconds patience) const;
  // The first event that waits until `limit`, once the states before it have been taken in.
  std::optional<RigEvent> first_until(Reader& reader, HostTime limit);

  const std::unique_ptr<RigEventSource> source_;
  const SimulatedPace pace_;
  mutable std::mutex mutex_;  // guards what follows, and the source
  std::array<Reader, 3> readers_;
  bool source_ended_ = false;
};

}  // namespace sparsight::simulated
