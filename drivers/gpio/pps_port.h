#pragma once

#include <chrono>
#include <string_view>

#include "hal/result.h"
#include "hal/rig_config.h"
#include "hal/time.h"

namespace sparsight {

// The pin and the serial port towards the LiDAR, and the clocks, so that tests can take their
// place.
class PpsPort {
 public:
  virtual ~PpsPort() = default;
  virtual Result<void> open(const TriggerConfig& config) = 0;
  virtual void close() = 0;  // leaves the pin low
  virtual bool set_pin(bool high) = 0;
  // False if not all of it was taken at once: a port that nobody reads must never hold up the
  // pulse.
  virtual bool send(std::string_view sentence) = 0;
  virtual void sleep_until(HostTime time) = 0;
  virtual HostTime now() = 0;
  virtual std::chrono::sys_time<std::chrono::nanoseconds> utc_now() = 0;
};

}  // namespace sparsight
