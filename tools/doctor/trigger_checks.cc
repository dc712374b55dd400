#include "tools/doctor/trigger_checks.h"

#include <fmt/format.h>

#include <cmath>

namespace sparsight {
namespace {

Check exposures(const TriggerObservation& seen, const RigConfig& rig) {
  const double per_second = static_cast<double>(seen.exposures) / seen.seconds;
  Check check{"exposure edges", Verdict::kOk,
              fmt::format("{:.1f} a second of {:g}", per_second, rig.camera.rate_hz), ""};
  const double expected = rig.camera.rate_hz * seen.seconds;
  // One more or less is the luck of where the observation begins and ends.
  const double off = std::abs(static_cast<double>(seen.exposures) - expected) - 1.0;
  if (seen.exposures == 0) {
    check.verdict = Verdict::kFail;
    check.fix = fmt::format(
        "no edge on line {} of {}: check wiring, [trigger] exposure_line and "
        "the camera's strobe output; gpiomon shows edges",
        rig.trigger.exposure_line, rig.trigger.chip);
  } else if (off > 0.02 * expected) {
    check.verdict = off > 0.2 * expected ? Verdict::kFail : Verdict::kWarn;
    check.fix =
        "edges and frames must be equally many: check for noise on the line, and that "
        "[trigger] exposure_active says what the line is";
  }
  return check;
}

Check losses(const TriggerObservation& seen) {
  Check check{"edge losses", Verdict::kOk,
              fmt::format("{} repeated, {} full reads of {} edges", seen.counters.repeated,
                          seen.counters.full_reads, seen.counters.edges),
              ""};
  if (seen.counters.repeated + seen.counters.full_reads > 0) {
    check.verdict = Verdict::kWarn;
    check.fix =
        "pulses are too short or the reading thread comes too late: set exposure_active = "
        "false for trigger pulses, and give the process real-time priority";
  }
  return check;
}

Check pps(const TriggerObservation& seen, unsigned line) {
  Check check{"PPS edges", Verdict::kOk, fmt::format("{} in {:.1f} s", seen.pulses, seen.seconds),
              ""};
  if (std::abs(static_cast<double>(seen.pulses) - seen.seconds) > 1.0) {
    check.verdict = Verdict::kFail;
    check.fix = fmt::format("one a second must come on line {}: check its source and wiring", line);
  }
  return check;
}

}  // namespace

TriggerObservation observe_trigger(TriggerLine& line, std::chrono::nanoseconds duration,
                                   const Now& now, const EventSink& sink) {
  TriggerObservation seen;
  if (auto started = line.start(); !started) {
    seen.error = started.error().message;
    return seen;
  }
  const HostTime begin = now();
  const HostTime end = begin + duration;
  for (HostTime time = begin; time < end; time = now()) {
    const auto edge = line.read(end - time);
    if (edge && sink) sink(*edge);
    if (!edge || !edge->rising) continue;
    ++(edge->line == EdgeLine::kPps ? seen.pulses : seen.exposures);
  }
  seen.seconds = to_seconds(now() - begin);
  seen.counters = line.counters();
  line.stop();
  return seen;
}

std::vector<Check> trigger_checks(const TriggerObservation& seen, const RigConfig& rig) {
  if (!seen.error.empty()) {
    return {{"exposure edges", Verdict::kFail, "not watched", seen.error}};
  }
  std::vector<Check> checks{exposures(seen, rig), losses(seen)};
  if (rig.trigger.pps_line) checks.push_back(pps(seen, *rig.trigger.pps_line));
  return checks;
}

}  // namespace sparsight
