#include "drivers/simulated/fault_plan.h"

#include <algorithm>

#include "drivers/simulated/random.h"

namespace sparsight::simulated {

bool FaultPlan::away(DeviceKind device, Elapsed at) const {
  return std::ranges::any_of(faults_.away, [&](const SimulatedFaults::Away& away) {
    return away.device == device && at >= away.from && at < away.from + away.lasting;
  });
}

std::uint32_t FaultPlan::times_away(DeviceKind device, Elapsed at) const {
  return static_cast<std::uint32_t>(
      std::ranges::count_if(faults_.away, [&](const SimulatedFaults::Away& away) {
        return away.device == device && at >= away.from + away.lasting;
      }));
}

bool FaultPlan::loses_edge(std::uint64_t number) const {
  return Random(seed_, 0xed9e, number).chance(faults_.lost_edges);
}

bool FaultPlan::loses_frame(std::uint64_t number) const {
  return Random(seed_, 0xf4a3e, number).chance(faults_.lost_frames);
}

bool FaultPlan::loses_packet(std::uint64_t number) const {
  return Random(seed_, 0x9ac4e7, number).chance(faults_.lost_packets);
}

bool FaultPlan::covered(Elapsed at) const {
  return std::ranges::any_of(faults_.covered, [&](const SimulatedFaults::Covered& covered) {
    return at >= covered.from && at < covered.from + covered.lasting;
  });
}

Elapsed FaultPlan::clock_jump(Elapsed at) const {
  const auto& jump = faults_.lidar_clock_jump;
  return jump && at >= jump->at ? jump->by : Elapsed{0};
}

}  // namespace sparsight::simulated
