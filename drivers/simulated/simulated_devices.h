#pragma once

#include <memory>
#include <optional>

#include "drivers/simulated/simulated_rig.h"
#include "hal/camera.h"
#include "hal/lidar.h"
#include "hal/trigger_line.h"

namespace sparsight {

namespace simulated {
class EventHub;
}

enum class SimulatedPace : std::uint8_t {
  kAsAsked,   // as fast as they are read; a device's clock moves on with what is read from it
  kRealTime,  // an event is there when CLOCK_MONOTONIC has reached its arrival
};

// The simulated rig behind the interfaces of the real devices; for what is written against those.
// The three share one rig and may live on threads of their own. What is not read waits, some
// seconds of it, then the oldest is dropped and counted; what comes while a device is stopped is
// gone.
class SimulatedDevices {
 public:
  explicit SimulatedDevices(std::unique_ptr<RigEventSource> rig, HostTime start,
                            SimulatedPace pace = SimulatedPace::kAsAsked);

  // Each may be asked for once and outlives this object.
  std::unique_ptr<Camera> camera();
  std::unique_ptr<Lidar> lidar();
  std::unique_ptr<TriggerLine> trigger_line();

 private:
  std::shared_ptr<simulated::EventHub> hub_;
};

}  // namespace sparsight
