#include "drivers/v4l2/camera_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "drivers/v4l2/control_list.h"

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

// V4L2_CID_EXPOSURE_ABSOLUTE counts these (USB video class).
constexpr nanoseconds kUvcUnit = std::chrono::microseconds(100);

Result<void> set_if_present(ControlList& controls, std::uint32_t id, std::int64_t value) {
  const auto* control = controls.find(id);
  if (!control) return {};
  const auto set = controls.set(*control, value);
  return set ? Result<void>() : tl::unexpected(set.error());
}

// One control that exposes for some multiple of a unit.
struct ExposureControl {
  const v4l2_query_ext_ctrl* control;
  double unit_ns;
};

// Image sensors count in lines, of (width + horizontal blanking) pixels each.
std::optional<double> line_ns(ControlList& controls, int width) {
  const auto* blanking = controls.find(std::uint32_t{V4L2_CID_HBLANK});
  const auto* rate = controls.find(std::uint32_t{V4L2_CID_PIXEL_RATE});
  if (!blanking || !rate) return std::nullopt;
  const auto pixels = controls.get(*blanking);
  const auto pixel_hz = controls.get(*rate);
  if (!pixels || pixel_hz.value_or(0) <= 0) return std::nullopt;
  return 1e9 * static_cast<double>(width + *pixels) / static_cast<double>(*pixel_hz);
}

std::optional<ExposureControl> exposure_control(ControlList& controls, int width) {
  if (const auto* absolute = controls.find(std::uint32_t{V4L2_CID_EXPOSURE_ABSOLUTE})) {
    return ExposureControl{absolute, static_cast<double>(kUvcUnit.count())};
  }
  const auto* lines = controls.find(std::uint32_t{V4L2_CID_EXPOSURE});
  const auto unit = line_ns(controls, width);
  if (!lines || !unit) return std::nullopt;
  return ExposureControl{lines, *unit};
}

nanoseconds time_of(const ExposureControl& control, std::int64_t value) {
  return nanoseconds(std::llround(static_cast<double>(value) * control.unit_ns));
}

Result<nanoseconds> set_exposure(ControlList& controls, nanoseconds exposure, int width) {
  if (auto manual = set_if_present(controls, V4L2_CID_EXPOSURE_AUTO, V4L2_EXPOSURE_MANUAL);
      !manual) {
    return tl::unexpected(manual.error());
  }
  // Else the frame rate falls in the dark.
  if (auto fixed = set_if_present(controls, V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0); !fixed) {
    return tl::unexpected(fixed.error());
  }
  const auto control = exposure_control(controls, width);
  if (!control) {
    return fail(ErrorCode::kMissingField,
                fmt::format("{}: has no exposure control in known units; leave [camera] "
                            "exposure_us out and set one of {} in [[camera.controls]]",
                            controls.device().path(), controls.names()));
  }
  const std::int64_t value = std::max(
      std::int64_t{1},
      std::int64_t{std::llround(static_cast<double>(exposure.count()) / control->unit_ns)});
  const auto in_force = controls.set(*control->control, value);
  if (!in_force) return tl::unexpected(in_force.error());
  return time_of(*control, *in_force);
}

// 0 unless the camera is known to be in manual mode.
nanoseconds exposure_in_force(ControlList& controls, int width) {
  if (const auto* mode = controls.find(std::uint32_t{V4L2_CID_EXPOSURE_AUTO})) {
    const auto chosen = controls.get(*mode);
    if (chosen != V4L2_EXPOSURE_MANUAL && chosen != V4L2_EXPOSURE_SHUTTER_PRIORITY) {
      return nanoseconds(0);
    }
  }
  const auto control = exposure_control(controls, width);
  const auto value = control ? controls.get(*control->control) : std::nullopt;
  return value ? time_of(*control, *value) : nanoseconds(0);
}

Result<void> set_gain(ControlList& controls, std::int64_t gain) {
  if (auto manual = set_if_present(controls, V4L2_CID_AUTOGAIN, 0); !manual) return manual;
  for (const std::uint32_t id : {V4L2_CID_GAIN, V4L2_CID_ANALOGUE_GAIN}) {
    if (controls.find(id)) return set_if_present(controls, id, gain);
  }
  return fail(ErrorCode::kMissingField,
              fmt::format("{}: has no gain control; leave [camera] gain out, or set one of {} in "
                          "[[camera.controls]]",
                          controls.device().path(), controls.names()));
}

Result<void> set_listed(ControlList& controls, const CameraControl& wanted) {
  const auto* control = controls.find(wanted.name);
  if (!control) {
    return fail(ErrorCode::kMissingField,
                fmt::format("{}: has no control \"{}\" of [[camera.controls]]; it has {}",
                            controls.device().path(), wanted.name, controls.names()));
  }
  const auto set = controls.set(*control, wanted.value);
  return set ? Result<void>() : tl::unexpected(set.error());
}

// A sensor that still exposes or reads out when the next trigger comes leaves that one out.
Result<void> check_period(const VideoDevice& device, nanoseconds exposure, double rate_hz) {
  const double most_s = 0.95 / rate_hz;
  if (to_seconds(exposure) < most_s) return {};
  return fail(ErrorCode::kOutOfRange,
              fmt::format("{}: exposes for {} us, which is not below 0.95 of the frame period "
                          "({:.0f} us at {} Hz); lower [camera] exposure_us or rate_hz",
                          device.path(), exposure.count() / 1000, most_s * 1e6, rate_hz));
}

}  // namespace

Result<nanoseconds> apply_settings(VideoDevice& device, const CameraConfig& config) {
  ControlList controls(device);
  if (config.exposure) {
    auto set = set_exposure(controls, *config.exposure, config.width);
    if (!set) return set;
  }
  if (config.gain) {
    if (auto set = set_gain(controls, *config.gain); !set) return tl::unexpected(set.error());
  }
  for (const CameraControl& control : config.controls) {
    if (auto set = set_listed(controls, control); !set) return tl::unexpected(set.error());
  }
  // The list may have changed what was set first.
  const nanoseconds exposure = exposure_in_force(controls, config.width);
  if (auto fits = check_period(device, exposure, config.rate_hz); !fits) {
    return tl::unexpected(fits.error());
  }
  return exposure;
}

}  // namespace sparsight
