#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "drivers/simulated/rig_clocks.h"
#include "drivers/simulated/world.h"
#include "hal/lidar.h"

namespace sparsight::simulated {

// Fires the lasers and writes packets. Arrivals are relative to the start. Thread-safe.
class LidarScanner {
 public:
  using PoseAt = std::function<Eigen::Isometry3d(Elapsed)>;  // T_world_lidar

  LidarScanner(const World& world, const LidarClock& clock, const PulseClock& pulses,
               const SimulationOptions& options, PoseAt pose);

  LidarPacket packet(std::uint64_t number) const;
  PositionPacket position(std::uint64_t after_packet) const;

 private:
  Ray beam(std::uint64_t packet, std::size_t sequence, std::size_t laser) const;
  // Distance in 2 mm and reflectivity; zeros where nothing comes back.
  std::pair<std::uint16_t, std::uint8_t> measure(const Ray& ray, const Hit& hit,
                                                 class Random& random) const;
  float reflectivity(const Ray& ray, const Hit& hit) const;

  const World& world_;
  const LidarClock& clock_;
  const PulseClock& pulses_;
  SimulationOptions options_;
  PoseAt pose_;
};

}  // namespace sparsight::simulated
