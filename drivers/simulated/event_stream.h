#pragma once

#include <optional>

#include "hal/rig_event.h"

namespace sparsight::simulated {

// One device's events in the order of their arrival.
class EventStream {
 public:
  virtual ~EventStream() = default;
  // Arrival of the next event; nothing after the last.
  virtual std::optional<HostTime> peek() const = 0;
  virtual RigEvent take() = 0;
};

}  // namespace sparsight::simulated
