#include "tools/doctor/camera_checks.h"

#include <fmt/format.h>

#include <cmath>

#include "drivers/v4l2/pixel_format_code.h"

namespace sparsight {
namespace {

Check found(const CameraObservation& seen, const CameraConfig& config) {
  if (!seen.error.empty()) return {"camera", Verdict::kFail, "not started", seen.error};
  if (seen.last.width == 0) {
    return {"camera", Verdict::kFail, config.device + ": started, but no frame came",
            "is it in trigger mode, and do triggers run? Does it get enough power and USB "
            "bandwidth?"};
  }
  Check check{"camera", Verdict::kOk,
              fmt::format("{}: {} {}x{}", config.device, code_of(seen.last.format).name,
                          seen.last.width, seen.last.height),
              ""};
  if (seen.last.format == PixelFormat::kMjpeg) {
    check.verdict = Verdict::kWarn;
    check.fix = "it offers compressed frames only at this size; they cost accuracy";
  }
  return check;
}

Check rate(const CameraObservation& seen, const CameraConfig& config) {
  Check check{"camera rate", Verdict::kOk,
              fmt::format("{:.2f} Hz of {:g}", seen.rate_hz, config.rate_hz), ""};
  const double off = std::abs(seen.rate_hz - config.rate_hz) / config.rate_hz;
  if (off > 0.02) {
    check.verdict = off > 0.2 ? Verdict::kFail : Verdict::kWarn;
    check.fix = seen.rate_hz < config.rate_hz
                    ? "shorten the exposure, switch off what lowers the rate in the dark, or set "
                      "[camera] rate_hz to the trigger's"
                    : "set [camera] rate_hz to the trigger's rate";
  }
  return check;
}

Check losses(const CameraObservation& seen) {
  const CameraCounters& counters = seen.counters;
  Check check{"camera losses", Verdict::kOk,
              fmt::format("{} lost, {} damaged, {} restarts of {} frames", counters.lost,
                          counters.damaged, counters.restarts, counters.frames),
              ""};
  const std::uint64_t bad = counters.lost + counters.damaged + counters.restarts;
  if (bad > 0) {
    check.verdict = 20 * bad > counters.frames ? Verdict::kFail : Verdict::kWarn;
    check.fix = "try a shorter cable or another port, and [camera] buffers = 8";
  }
  return check;
}

Check exposure(const CameraObservation& seen, const CameraConfig& config) {
  const auto time = seen.last.exposure;
  if (time.count() == 0) {
    return {"exposure", Verdict::kWarn, "automatic, or not told by the camera",
            "set [camera] exposure_us: without it, the middle of an exposure is known only from "
            "the exposure line"};
  }
  Check check{"exposure", Verdict::kOk,
              fmt::format("{} us, {:.0f} % of the period", time.count() / 1000,
                          100.0 * to_seconds(time) * config.rate_hz),
              ""};
  if (to_seconds(time) * config.rate_hz >= 0.95) {
    check.verdict = Verdict::kFail;
    check.fix = "lower [camera] exposure_us: every second trigger would be left out";
  } else if (time > std::chrono::milliseconds(10)) {
    check.verdict = Verdict::kWarn;  // 1 rad/s turns by 10 mrad meanwhile: 5 pixels at f = 500
    check.fix = "lower [camera] exposure_us and raise gain: turning will blur the image";
  }
  return check;
}

}  // namespace

CameraObservation observe_camera(Camera& camera, std::chrono::nanoseconds duration, const Now& now,
                                 const EventSink& sink) {
  CameraObservation seen;
  if (auto started = camera.start(); !started) {
    seen.error = started.error().message;
    return seen;
  }
  const HostTime end = now() + duration;
  std::optional<HostTime> first;
  int frames = 0;
  for (HostTime time = now(); time < end; time = now()) {
    auto frame = camera.read(end - time);
    if (!frame) continue;
    if (!first) first = frame->arrival;
    ++frames;
    if (sink) sink(std::make_shared<const CameraFrame>(*frame));
    frame->bytes.clear();
    seen.last = std::move(*frame);
  }
  if (frames > 1) seen.rate_hz = (frames - 1) / to_seconds(seen.last.arrival - *first);
  seen.counters = camera.counters();
  camera.stop();
  return seen;
}

std::vector<Check> camera_checks(const CameraObservation& seen, const CameraConfig& config) {
  std::vector<Check> checks{found(seen, config)};
  if (!seen.error.empty() || seen.last.width == 0) return checks;
  checks.push_back(rate(seen, config));
  checks.push_back(losses(seen));
  checks.push_back(exposure(seen, config));
  return checks;
}

}  // namespace sparsight
