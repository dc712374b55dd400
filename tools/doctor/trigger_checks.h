#pragma once

#include <string>
#include <vector>

#include "hal/rig_config.h"
#include "hal/trigger_line.h"
#include "tools/doctor/check.h"
#include "tools/doctor/event_collector.h"

namespace sparsight {

struct TriggerObservation {
  std::string error;  // why it could not be started; "" if it could
  double seconds = 0.0;
  std::uint64_t exposures = 0;  // rising edges
  std::uint64_t pulses = 0;     // rising edges of PPS
  TriggerCounters counters;
};

// Starts the lines, reads them for a while, stops them.
TriggerObservation observe_trigger(TriggerLine& line, std::chrono::nanoseconds duration,
                                   const Now& now, const EventSink& sink = {});

// Exposure edges per second, losses, and PPS where it is wired.
std::vector<Check> trigger_checks(const TriggerObservation& seen, const RigConfig& rig);

}  // namespace sparsight
