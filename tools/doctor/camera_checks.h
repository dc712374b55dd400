#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hal/camera.h"
#include "hal/rig_config.h"
#include "tools/doctor/check.h"
#include "tools/doctor/event_collector.h"

namespace sparsight {

struct CameraObservation {
  std::string error;     // why it could not be started; "" if it could
  double rate_hz = 0.0;  // between the first frame and the last
  CameraFrame last;      // without its bytes; width 0: none came
  CameraCounters counters;
};

// Starts the camera, reads it for a while, stops it.
CameraObservation observe_camera(Camera& camera, std::chrono::nanoseconds duration, const Now& now,
                                 const EventSink& sink = {});

// Found and format, rate, losses, exposure.
std::vector<Check> camera_checks(const CameraObservation& seen, const CameraConfig& config);

}  // namespace sparsight
