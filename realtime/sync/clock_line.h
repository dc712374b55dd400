#pragma once

#include <chrono>
#include <cmath>

#include "hal/stamp.h"
#include "hal/time.h"

namespace sparsight {

// A sensor's clock on the host's, as a straight line through one pair of times.
struct ClockLine {
  SensorTime sensor;
  HostTime host;
  double rate = 1.0;  // host nanoseconds per sensor nanosecond

  HostTime at(SensorTime time) const {
    const auto since = static_cast<double>((time - sensor).count());
    // The rate is so near one that only its difference needs a floating point.
    return host + (time - sensor) + std::chrono::nanoseconds(std::llround((rate - 1.0) * since));
  }
  SensorTime sensor_at(HostTime time) const {
    const auto since = static_cast<double>((time - host).count());
    return sensor + (time - host) -
           std::chrono::nanoseconds(std::llround((rate - 1.0) / rate * since));
  }
};

struct ClockMapping {
  ClockLine line;
  std::chrono::nanoseconds uncertainty{0};  // one sigma of a mapped time
  StampQuality quality = StampQuality::kEstimated;
};

}  // namespace sparsight
