#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/lidar.h"
#include "hal/rig_config.h"
#include "tools/doctor/check.h"
#include "tools/doctor/event_collector.h"

namespace sparsight {

struct LidarObservation {
  std::string error;  // why it could not be started; "" if it could
  double packets_per_s = 0.0;
  LidarCounters counters;
  DecoderCounters decoded;
  std::optional<LidarClockReport> clock;  // the last
};

// Starts the LiDAR, reads and decodes it for a while, stops it.
LidarObservation observe_lidar(Lidar& lidar, LidarDecoder& decoder,
                               std::chrono::nanoseconds duration, const Now& now,
                               const EventSink& sink = {});

// Found and packets per second, losses, PPS.
std::vector<Check> lidar_checks(const LidarObservation& seen, const RigConfig& rig);

}  // namespace sparsight
