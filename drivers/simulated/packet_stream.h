#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "drivers/simulated/event_stream.h"
#include "drivers/simulated/lidar_scanner.h"
#include "drivers/simulated/made_ahead.h"

namespace sparsight::simulated {

// The LiDAR's data and position packets.
class PacketStream : public EventStream {
 public:
  PacketStream(const LidarScanner& scanner, const LidarClock& clock, const FaultPlan& faults,
               const SimulationOptions& options);

  std::optional<HostTime> peek() const override;
  RigEvent take() override;

 private:
  std::vector<LidarMessage> make(std::uint64_t bundle) const;
  void refill();

  const LidarScanner& scanner_;
  const LidarClock& clock_;
  const FaultPlan& faults_;
  SimulationOptions options_;
  std::uint64_t packets_ = 0;
  std::uint64_t bundles_ = 0;
  std::uint64_t next_bundle_ = 0;
  HostTime last_arrival_;
  std::deque<RigEvent> ready_;
  MadeAhead<std::vector<LidarMessage>> bundles_ahead_;
};

}  // namespace sparsight::simulated
