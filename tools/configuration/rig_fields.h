#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/rig_config.h"
#include "tools/configuration/field_range.h"
#include "tools/configuration/rig_text_rules.h"
#include "tools/configuration/transform_fields.h"

namespace sparsight {

inline constexpr FieldRange kImageSide{16, 16384};
inline constexpr FieldRange kPort{1, 65535};
inline constexpr FieldRange kGpioLine{0, 1023};
inline constexpr FieldRange kDegrees{0.0, 360.0};
inline constexpr FieldRange kExact{-0x1p53, 0x1p53};  // whole numbers that any reader keeps

inline const std::vector<std::pair<std::string_view, ReturnMode>> kReturnModes = {
    {"strongest", ReturnMode::kStrongest},
    {"last", ReturnMode::kLast},
    {"dual", ReturnMode::kDual}};

// The rig as its file has it: a table per struct, a key per field, and what must hold of several
// together. A test counts the fields against the structs.

template <typename Visitor>
void visit_fields(Visitor& file, CameraIntrinsics& camera) {
  file.required_field("width", camera.width, kImageSide);
  file.required_field("height", camera.height, kImageSide);
  file.required_field("fx", camera.fx, {1.0, 1e5});
  file.required_field("fy", camera.fy, {1.0, 1e5});
  file.required_field("cx", camera.cx, {0.0, 16384.0});
  file.required_field("cy", camera.cy, {0.0, 16384.0});
  file.field("k1", camera.k1, {-100.0, 100.0});
  file.field("k2", camera.k2, {-100.0, 100.0});
  file.field("p1", camera.p1, {-100.0, 100.0});
  file.field("p2", camera.p2, {-100.0, 100.0});
  file.field("k3", camera.k3, {-100.0, 100.0});
  file.check("cx", camera.cx < camera.width, "must lie in the image: below its width");
  file.check("cy", camera.cy < camera.height, "must lie in the image: below its height");
}

template <typename Visitor>
void visit_fields(Visitor& file, RigCalibration& rig) {
  file.optional_table("camera", rig.camera, rig.camera.width != 0);
  // No rig has its camera and LiDAR axes alike, so identity would be a forgotten transform.
  if (rig.camera.width != 0) file.require("T_camera_lidar");
  file.transform("T_camera_lidar", rig.T_camera_lidar, "p_camera = T_camera_lidar * p_lidar");
}

template <typename Visitor>
void visit_fields(Visitor& file, CameraControl& control) {
  file.require("name");
  file.text("name", control.name, some_text());
  file.required_field("value", control.value, kExact);
}

template <typename Visitor>
void visit_fields(Visitor& file, CameraConfig& camera) {
  file.text("device", camera.device, some_text());
  file.field("width", camera.width, kImageSide);
  file.field("height", camera.height, kImageSide);
  file.field("rate_hz", camera.rate_hz, {1.0, 1000.0});
  file.text("format", camera.format, pixel_format_or_auto());
  file.field("buffers", camera.buffers, {2, 32});
  file.field("exposure_us", camera.exposure, {1, 1'000'000});
  file.field("gain", camera.gain, kExact);
  file.list("controls", camera.controls);
  // A sensor that is still exposing when the next trigger comes leaves that one out.
  const double exposed_s =
      std::chrono::duration<double>(camera.exposure.value_or(std::chrono::microseconds(0))).count();
  file.check("exposure_us", exposed_s < 0.95 / camera.rate_hz,
             fmt::format("must be below 0.95 of the frame period, {:.0f} us at {} Hz",
                         0.95e6 / camera.rate_hz, camera.rate_hz));
}

template <typename Visitor>
void visit_fields(Visitor& file, LidarConfig& lidar) {
  file.text("sensor_address", lidar.sensor_address, ipv4_address_or_nothing());
  file.text("bind_address", lidar.bind_address, ipv4_address());
  file.field("data_port", lidar.data_port, kPort);
  file.field("position_port", lidar.position_port, kPort);
  file.field("seam_azimuth_deg", lidar.seam_azimuth_deg, kDegrees);
  file.field("min_range_m", lidar.min_range_m, {0.0, 100.0});
  file.field("max_range_m", lidar.max_range_m, {0.1, 250.0});
  file.field("rpm", lidar.rpm, {300, 1200});
  file.choice("return_mode", lidar.return_mode, kReturnModes);
  file.field("phase_lock_deg", lidar.phase_lock_deg, kDegrees);
  file.field("elevation_deg", lidar.elevation_deg, {-90.0, 90.0});
  file.field("vertical_offset_mm", lidar.vertical_offset_mm, {-100.0, 100.0});
  file.check("position_port", lidar.position_port != lidar.data_port, "must differ from data_port");
  file.check("max_range_m", lidar.max_range_m > lidar.min_range_m, "must be above min_range_m");
  // VLP-16 manual 63-9243 Rev D, p. 50: otherwise neither speed nor phase is held.
  file.check("rpm", lidar.rpm.value_or(0) % 60 == 0, "must be a multiple of 60");
  file.check("elevation_deg",
             !lidar.elevation_deg ||
                 std::ranges::adjacent_find(*lidar.elevation_deg, std::greater_equal<>()) ==
                     lidar.elevation_deg->end(),
             "must rise from the lowest laser to the highest");
}

template <typename Visitor>
void visit_fields(Visitor& file, TriggerConfig& trigger) {
  file.text("chip", trigger.chip, some_text());
  file.field("exposure_line", trigger.exposure_line, kGpioLine);
  file.field("exposure_active", trigger.exposure_active);
  file.field("active_low", trigger.active_low);
  file.field("trigger_delay_us", trigger.trigger_delay, {0, 1'000'000});
  file.field("pps_line", trigger.pps_line, kGpioLine);
  file.field("pps_output_line", trigger.pps_output_line, kGpioLine);
  file.text("nmea_device", trigger.nmea_device, any_text());
  file.check("pps_line", trigger.pps_line != trigger.exposure_line,
             "is exposure_line already; each signal needs a line of its own");
  file.check("pps_output_line",
             trigger.pps_output_line != trigger.exposure_line &&
                 (!trigger.pps_output_line || trigger.pps_output_line != trigger.pps_line),
             "is an input already; each signal needs a line of its own");
}

template <typename Visitor>
void visit_fields(Visitor& file, RigConfig& rig) {
  file.text("name", rig.name, some_text());
  file.table("calibration", rig.calibration);
  file.table("camera", rig.camera);
  file.table("lidar", rig.lidar);
  file.table("trigger", rig.trigger);
  const CameraIntrinsics& made_for = rig.calibration.camera;
  file.check("calibration",
             made_for.width == 0 ||
                 (made_for.width == rig.camera.width && made_for.height == rig.camera.height),
             fmt::format("[calibration.camera] is for {}x{}, [camera] streams {}x{}; calibrate at "
                         "the size that is streamed",
                         made_for.width, made_for.height, rig.camera.width, rig.camera.height));
}

}  // namespace sparsight
