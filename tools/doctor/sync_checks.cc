#include "tools/doctor/sync_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sparsight {
namespace {

double milliseconds(std::chrono::nanoseconds duration) { return 1e3 * to_seconds(duration); }

Check matched(const CameraSyncState& camera) {
  // With the first eight, the matching is found; they have nobody to vouch for them.
  constexpr std::uint64_t kToBegin = 8;
  const std::uint64_t without =
      camera.frames_unsynchronized - std::min(camera.frames_unsynchronized, kToBegin);
  const std::uint64_t guessed = camera.frames_estimated;
  const auto frames = static_cast<double>(std::max<std::uint64_t>(1, camera.frames));
  const double share = 1.0 - static_cast<double>(without + guessed) / frames;
  Check check{"edges matched",
              Verdict::kOk,
              fmt::format("{:.1f} % of {} frames have their edges; {} are known from the edges "
                          "around them, {} not at all",
                          100.0 * share, camera.frames, guessed, without),
              "",
              {{"share", share}, {"edges_lost", static_cast<double>(camera.edges_lost)}}};
  if (camera.edges_matched == 0) {
    check.verdict = Verdict::kFail;
    check.found = fmt::format("none: no edge could be matched to any of {} frames", camera.frames);
    check.fix =
        "frames and edges must be equally many and 8 frames in a row arrive at a steady delay: see "
        "the checks of camera and edges, and [trigger] exposure_active and trigger_delay_us";
  } else if (share < 0.99) {
    check.verdict = share < 0.9 ? Verdict::kFail : Verdict::kWarn;
    check.fix =
        "edges are lost or doubled, or frames come late: shorten the wire or add a pull resistor, "
        "and give the process real-time priority";
  }
  return check;
}

Check camera_clock(const CameraSyncState& camera) {
  Check check{
      "camera clock",
      Verdict::kOk,
      fmt::format("frames come {:.2f} ms after their exposure, {:.3f} ms later in the mean; "
                  "edges jitter by {:.0f} us",
                  milliseconds(camera.delay), milliseconds(camera.delay_spread),
                  1e3 * milliseconds(camera.edge_jitter)),
      "",
      {{"delay_ms", milliseconds(camera.delay)},
       {"delay_spread_ms", milliseconds(camera.delay_spread)},
       {"edge_jitter_us", 1e3 * milliseconds(camera.edge_jitter)}}};
  if (camera.delay_spread > camera.period / 5) {
    check.verdict = Verdict::kWarn;
    check.fix = "frames come irregularly: another USB port, fewer devices on it, less load";
  } else if (camera.edge_jitter > std::chrono::microseconds(200)) {
    check.verdict = Verdict::kWarn;
    check.fix =
        "the trigger is irregular, or its interrupts are late: is it made by software? Is the line "
        "behind an expander?";
  }
  return check;
}

Check lidar_clock(const LidarClockState& lidar) {
  if (lidar.source == LidarClockSource::kNone) {
    return {"lidar clock", Verdict::kFail, "unknown: no packets", "see the check of the LiDAR"};
  }
  const bool pps = lidar.source == LidarClockSource::kPps;
  Check check{
      "lidar clock",
      Verdict::kOk,
      fmt::format("by {}: the host is {:.6f} s ahead, drifts by {:+.1f} ppm; known to {:.0f} us, "
                  "packets come {:.3f} ms late in the mean",
                  pps ? "PPS" : "arrivals", to_seconds(lidar.offset), lidar.drift_ppm,
                  1e3 * milliseconds(lidar.uncertainty), milliseconds(lidar.spread)),
      "",
      {{"offset_s", to_seconds(lidar.offset)},
       {"drift_ppm", lidar.drift_ppm},
       {"spread_ms", milliseconds(lidar.spread)},
       {"uncertainty_us", 1e3 * milliseconds(lidar.uncertainty)}}};
  // Once, as the sensor says for the first time that it is locked.
  if (lidar.restarts > 1) {
    check.verdict = Verdict::kWarn;
    check.found += fmt::format(", begun anew {} times", lidar.restarts);
    check.fix = "the sensor's clock was set meanwhile: let PPS settle before you begin";
  } else if (lidar.uncertainty > std::chrono::milliseconds(1)) {
    check.verdict = Verdict::kWarn;
    check.fix = "packets arrive irregularly: connect the LiDAR directly, or wire PPS";
  }
  return check;
}

}  // namespace

std::vector<Check> sync_checks(const SyncState& state) {
  std::vector<Check> checks;
  if (state.camera.frames > 0) checks.push_back(matched(state.camera));
  if (state.camera.edges_matched > 0) checks.push_back(camera_clock(state.camera));
  if (state.packets.decoded > 0) checks.push_back(lidar_clock(state.lidar));
  return checks;
}

}  // namespace sparsight
