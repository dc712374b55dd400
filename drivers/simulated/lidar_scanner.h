#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <vector>

#include "drivers/simulated/rig_clocks.h"
#include "drivers/simulated/world.h"
#include "drivers/vlp16/packet_writer.h"
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
  struct Echo {
    std::uint16_t distance_2mm = 0;  // 0: nothing comes back
    std::uint8_t reflectivity = 0;
    float strength = 0.0F;  // light that comes back
  };
  struct Echoes {
    Echo last;
    Echo other;  // the strongest; the second strongest where the last is the strongest
  };

  Ray beam(std::uint64_t packet, std::size_t sequence, std::size_t laser) const;
  Echo measure(const Ray& ray, const Hit& hit, class Random& random) const;
  // Of all that the beam's width meets.
  Echoes measure_all(const Ray& middle, class Random& random) const;
  void fire(std::uint64_t packet, std::size_t sequence, FiringSequence& last, FiringSequence& other,
            class Random& random) const;
  float reflectivity(const Ray& ray, const Hit& hit) const;

  const World& world_;
  const LidarClock& clock_;
  const PulseClock& pulses_;
  SimulationOptions options_;
  PoseAt pose_;
};

}  // namespace sparsight::simulated
