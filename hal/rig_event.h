#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "hal/camera.h"
#include "hal/device.h"
#include "hal/lidar.h"
#include "hal/time.h"
#include "hal/trigger_line.h"

namespace sparsight {

struct DeviceStateChange {
  DeviceKind device;
  DeviceState state;
  HostTime at;
};

// Everything raw that a rig delivers. Frames are shared, as the recorder and the estimator both
// take them.
using RigEvent = std::variant<std::shared_ptr<const CameraFrame>, Edge, LidarPacket, PositionPacket,
                              DeviceStateChange>;

// When the event reached the host: the order in which a rig's events are recorded and replayed. An
// edge counts as having arrived when it happened.
HostTime arrival_of(const RigEvent& event);

// Raw events in the order of their arrival: a recording, the simulated rig. Thread-bound.
class RigEventSource {
 public:
  virtual ~RigEventSource() = default;
  virtual std::optional<RigEvent> next() = 0;  // nothing after the last
};

}  // namespace sparsight
