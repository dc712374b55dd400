#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "hal/time.h"

namespace sparsight {

// Where a mapped time comes from; a later one is better.
enum class StampQuality : std::uint8_t {
  kArrival,    // the host's clock when the data came: late by an unknown delay
  kEstimated,  // a clock model fitted to arrivals, or an edge put in where one was lost
  kMeasured,   // this datum's own edge, or a clock locked to PPS
};

// When something happened, on every clock that has an opinion. Nothing downstream invents a time.
struct Stamp {
  std::optional<SensorTime> device;  // by the sensor's own clock, where it has one
  HostTime arrival;
  HostTime mapped;                       // the best estimate of when it happened
  std::chrono::nanoseconds uncertainty;  // one sigma of `mapped`
  std::uint32_t epoch = 0;  // counts restarts of the device clock; compare times within one only
  StampQuality quality = StampQuality::kArrival;
};

}  // namespace sparsight
