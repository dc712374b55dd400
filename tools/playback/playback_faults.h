#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "drivers/simulated/fault_plan.h"
#include "hal/rig_event.h"

namespace sparsight {

// What is kept from the devices on purpose. Thread-bound.
class PlaybackFaults {
 public:
  // Of `faults`: the times when a device is away, counted from `first`; and lost_edges, the share
  // of exposures that do not show on their line, neither beginning nor end. The same `seed`, the
  // same ones.
  PlaybackFaults(const SimulatedFaults& faults, HostTime first, std::uint64_t seed)
      : plan_(faults, seed), first_(first) {}

  // Asked for every event in turn.
  bool withhold(const RigEvent& event);

 private:
  bool loses(const Edge& edge);

  simulated::FaultPlan plan_;
  HostTime first_;
  std::uint64_t exposures_ = 0;
};

// Which device an event comes from.
DeviceKind device_of(const RigEvent& event);

}  // namespace sparsight
