#pragma once

#include <string>

#include "drivers/vlp16/sensor_web.h"

namespace sparsight {

// What the sensor's web interface answers. Firmware differs in whether numbers are numbers or text:
// both are read. `source` is for error messages.
Result<SensorSettings> parse_sensor_settings(const std::string& text, const std::string& source);
Result<SensorStatus> parse_sensor_status(const std::string& text, const std::string& source);
Result<SensorDiagnostics> parse_sensor_diagnostics(const std::string& text,
                                                   const std::string& source);

}  // namespace sparsight
