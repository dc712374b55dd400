#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/simulated/ground_truth.h"
#include "drivers/simulated/simulation_options.h"
#include "hal/result.h"
#include "hal/rig_config.h"
#include "hal/rig_event.h"

namespace sparsight {

namespace simulated {
struct Scene;
}

// A rig that a person carries through a made place: frames, trigger edges, LiDAR packets with the
// timing, noise and clocks of the real devices. The same options give the same bytes. Frames are
// rendered ahead on threads of their own. Thread-bound.
class SimulatedRig : public RigEventSource {
 public:
  explicit SimulatedRig(const SimulationOptions& options);
  // In a place of one's own instead of that of the options.
  SimulatedRig(const SimulationOptions& options, simulated::Scene scene);
  ~SimulatedRig() override;
  SimulatedRig(const SimulatedRig&) = delete;
  SimulatedRig& operator=(const SimulatedRig&) = delete;

  std::optional<RigEvent> next() override;

  const RigConfig& rig_config() const;
  const SimulatedTruth& ground_truth() const;
  const SimulationOptions& options() const;

  // Depth (z) the camera would see at a time, row after row; infinite in the sky. For tests and
  // pictures.
  std::vector<float> camera_depth(HostTime at) const;
  // How far the nearest surface is along a ray in the world; nothing in the sky.
  std::optional<double> distance(const Eigen::Vector3d& p_world,
                                 const Eigen::Vector3d& direction_world) const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// The rig's calibration and settings, without making its world.
RigConfig simulated_rig_config(const SimulationOptions& options);

// What of the options cannot be simulated; the message names the option and its range.
Result<void> check(const SimulationOptions& options);

}  // namespace sparsight
