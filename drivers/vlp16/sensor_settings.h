#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "drivers/vlp16/sensor_web.h"
#include "hal/result.h"
#include "hal/rig_config.h"

namespace sparsight {

struct ReadBack {
  // The sensor is said to bear about one request a second; it takes over at its leisure.
  std::chrono::milliseconds pause{500};
  int attempts = 4;
};

// Sets the sensor to what the configuration names (rpm, return mode, phase lock), posting only what
// differs, and reads every setting back: the sensor answers "200 OK" to what it refuses as well.
// Gives what was changed, for a person to read. The settings last until the sensor loses power;
// they are not saved in it, as they are made anew at each start.
// An error leaves a sensor that scans as it did: say it, and go on.
Result<std::vector<std::string>> apply_sensor_settings(const LidarConfig& config,
                                                       const SensorWeb& web,
                                                       const ReadBack& read_back = {});

// What is wrong with the settings that the configuration asks for.
Result<void> check_sensor_settings(const LidarConfig& config);

}  // namespace sparsight
