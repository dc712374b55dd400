#pragma once

#include <cstddef>
#include <vector>

#include "drivers/simulated/event_stream.h"
#include "drivers/simulated/rig_clocks.h"

namespace sparsight::simulated {

// The GPIO lines: exposure active, and the second's pulse where it is wired.
class EdgeStream : public EventStream {
 public:
  EdgeStream(const SimulationOptions& options, const CameraClock& camera, const PulseClock& pulses,
             const FaultPlan& faults);

  std::optional<HostTime> peek() const override;
  RigEvent take() override { return edges_[next_++]; }

 private:
  std::vector<Edge> edges_;
  std::size_t next_ = 0;
};

// What a rig notices when a device goes away and comes back.
class StateStream : public EventStream {
 public:
  StateStream(const SimulationOptions& options);

  std::optional<HostTime> peek() const override;
  RigEvent take() override { return changes_[next_++]; }

 private:
  std::vector<DeviceStateChange> changes_;
  std::size_t next_ = 0;
};

}  // namespace sparsight::simulated
