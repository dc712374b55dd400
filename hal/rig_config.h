#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/calibration.h"

namespace sparsight {

// A V4L2 control by its name as the driver lists it ("Exposure, Auto") or by number ("0x009a0901").
struct CameraControl {
  std::string name;
  std::int64_t value = 0;
};

struct CameraConfig {
  std::string device = "/dev/video0";  // better a stable path: /dev/v4l/by-id/... or by-path/...
  int width = 800;
  int height = 600;
  double rate_hz = 30.0;
  std::string format = "auto";  // "auto" takes the first offered in the order of PixelFormat
  int buffers = 6;
  std::optional<std::chrono::microseconds> exposure;  // switches automatic exposure off
  std::optional<std::int64_t> gain;
  std::vector<CameraControl> controls;  // applied last, in this order
};

enum class ReturnMode : std::uint8_t { kStrongest, kLast, kDual };

struct LidarConfig {
  std::string sensor_address =
      "192.168.1.201";  // packets of other senders are refused; "" takes all
  std::string bind_address = "0.0.0.0";
  std::uint16_t data_port = 2368;
  std::uint16_t position_port = 8308;
  double seam_azimuth_deg = 180.0;  // revolutions are cut here; clockwise from ahead, from above
  double min_range_m = 0.5;
  double max_range_m = 100.0;
  // What the sensor is set to over HTTP; nothing set: the sensor is left as it is.
  std::optional<int> rpm;
  std::optional<ReturnMode> return_mode;
  std::optional<double> phase_lock_deg;
  // Per laser from the lowest to the highest; the nominal table where absent.
  std::optional<std::array<double, 16>> elevation_deg;
  std::optional<std::array<double, 16>> vertical_offset_mm;
};

struct TriggerConfig {
  std::string chip = "/dev/gpiochip0";
  unsigned exposure_line = 0;
  // The line is high (or, active low, low) while the sensor is exposed: both edges count. Otherwise
  // one edge triggers, and exposure begins after `trigger_delay`.
  bool exposure_active = true;
  bool active_low = false;
  std::chrono::microseconds trigger_delay{0};
  std::optional<unsigned> pps_line;         // PPS seen by the host
  std::optional<unsigned> pps_output_line;  // PPS given to the LiDAR by the host
  std::string nmea_device;                  // serial port towards the LiDAR; "" where there is none
};

// Everything that describes one rig; lives in one TOML file.
struct RigConfig {
  std::string name = "rig";
  RigCalibration calibration;
  CameraConfig camera;
  LidarConfig lidar;
  TriggerConfig trigger;
};

}  // namespace sparsight
