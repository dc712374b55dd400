#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "hal/lidar.h"
#include "hal/result.h"
#include "hal/rig_config.h"

namespace sparsight {

// The sensor's own web interface. What it says is plain HTTP from anywhere on the network: checked
// like every other input. Fields that a firmware does not have are absent.

// GET /cgi/settings.json: how the sensor is set.
struct SensorSettings {
  std::optional<int> rpm;
  std::optional<ReturnMode> return_mode;
  std::optional<bool> laser_on;
  std::optional<bool> phase_lock;
  std::optional<int> phase_lock_centideg;  // the interface's unit, whatever the page beside it says
  std::optional<int> view_start_deg;
  std::optional<int> view_end_deg;
};

// GET /cgi/status.json: what it does.
struct SensorStatus {
  std::optional<PpsState> pps;
  std::string gps_position;
  std::optional<bool> motor_on;
  std::optional<int> motor_rpm;
  std::optional<bool> laser_on;
};

// GET /cgi/diag.json, in units.
struct SensorDiagnostics {
  std::optional<double> top_temperature_c;
  std::optional<double> bottom_temperature_c;
  std::optional<double> current_a;
};

struct SensorWebOptions {
  std::uint16_t port = 80;
  std::chrono::milliseconds timeout{2000};  // of connecting, and of each answer as a whole
};

// Blocks for as long as its timeout: never to be used by a real-time thread. Thread-bound.
class SensorWeb {
 public:
  explicit SensorWeb(std::string address, const SensorWebOptions& options = {});

  Result<SensorSettings> settings() const;
  Result<SensorStatus> status() const;
  Result<SensorDiagnostics> diagnostics() const;
  // `form` as in "rpm=600". That the sensor answers well does not mean that it obeyed.
  Result<void> post(const std::string& path, const std::string& form) const;

 private:
  Result<std::string> get(const std::string& path) const;
  std::string url(const std::string& path) const;

  std::string address_;
  SensorWebOptions options_;
};

}  // namespace sparsight
