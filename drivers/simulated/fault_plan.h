#pragma once

#include <chrono>
#include <cstdint>

#include "drivers/simulated/simulation_options.h"

namespace sparsight::simulated {

// Times count from the start of the simulation.
using Elapsed = std::chrono::nanoseconds;

// Says of every datum whether it is lost, the same whoever asks and when.
class FaultPlan {
 public:
  FaultPlan(const SimulatedFaults& faults, std::uint64_t seed) : faults_(faults), seed_(seed) {}

  bool away(DeviceKind device, Elapsed at) const;
  // How often the device has gone away before this time: its epoch.
  std::uint32_t times_away(DeviceKind device, Elapsed at) const;
  bool loses_edge(std::uint64_t number) const;
  bool loses_frame(std::uint64_t number) const;
  bool loses_packet(std::uint64_t number) const;
  Elapsed clock_jump(Elapsed at) const;
  bool covered(Elapsed at) const;
  const SimulatedFaults& faults() const { return faults_; }

 private:
  SimulatedFaults faults_;
  std::uint64_t seed_;
};

}  // namespace sparsight::simulated
