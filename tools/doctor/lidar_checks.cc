#include "tools/doctor/lidar_checks.h"

#include <fmt/format.h>

#include <cmath>

namespace sparsight {
namespace {

// 24 or, for two returns, 12 firing sequences of 55.296 us fill a packet, whatever the speed of
// rotation (VLP-16 manual 63-9243 Rev D, p. 49).
constexpr double kSinglePerSecond = 1e6 / (24 * 55.296);
constexpr double kDualPerSecond = 1e6 / (12 * 55.296);

Check found(const LidarObservation& seen, const LidarConfig& config) {
  if (!seen.error.empty()) return {"lidar", Verdict::kFail, "not started", seen.error};
  if (seen.counters.packets == 0) {
    std::string found = fmt::format("no packet on UDP port {}", config.data_port);
    if (seen.counters.refused > 0) {
      found += fmt::format(", {} refused of other senders or sizes", seen.counters.refused);
    }
    return {"lidar", Verdict::kFail, found,
            fmt::format("is it powered and cabled, is this host in its subnet ({}), is it told to "
                        "send here? tcpdump -n udp port {} shows what comes",
                        config.sensor_address.empty() ? "any" : config.sensor_address,
                        config.data_port)};
  }
  return {"lidar", Verdict::kOk,
          fmt::format("{} packets on UDP port {}", seen.counters.packets, config.data_port), ""};
}

double expected_rate(const LidarObservation& seen, const LidarConfig& config) {
  if (config.return_mode) {
    return *config.return_mode == ReturnMode::kDual ? kDualPerSecond : kSinglePerSecond;
  }
  const bool dual = std::abs(seen.packets_per_s - kDualPerSecond) <
                    std::abs(seen.packets_per_s - kSinglePerSecond);
  return dual ? kDualPerSecond : kSinglePerSecond;
}

Check rate(const LidarObservation& seen, const LidarConfig& config) {
  const double expected = expected_rate(seen, config);
  Check check{"lidar rate", Verdict::kOk,
              fmt::format("{:.1f} packets/s of {:.1f}", seen.packets_per_s, expected), ""};
  const double off = std::abs(seen.packets_per_s - expected) / expected;
  if (off > 0.01) {
    check.verdict = off > 0.1 ? Verdict::kFail : Verdict::kWarn;
    check.fix =
        "compare [lidar] return_mode with the sensor's web page; a narrowed field of view "
        "sends less, a second sensor on the port more";
  }
  return check;
}

Check losses(const LidarObservation& seen) {
  Check check{"lidar losses", Verdict::kOk,
              fmt::format("{} lost, {} dropped by the kernel, {} refused, {} reordered",
                          seen.decoded.lost, seen.counters.dropped,
                          seen.counters.refused + seen.decoded.refused, seen.decoded.reordered),
              ""};
  const std::uint64_t lost = seen.decoded.lost + seen.counters.dropped;
  if (lost > 0 || seen.decoded.refused > 0) {
    check.verdict = 100 * lost > seen.counters.packets ? Verdict::kFail : Verdict::kWarn;
    check.fix = seen.counters.dropped > 0
                    ? "raise net.core.rmem_max, and give the process real-time priority"
                    : "check cable and switch: packets are lost before they reach this host";
  }
  return check;
}

Check pps(const LidarObservation& seen, const TriggerConfig& trigger) {
  const bool wanted = trigger.pps_line || trigger.pps_output_line;
  const Verdict bad = wanted ? Verdict::kFail : Verdict::kWarn;
  if (!seen.clock) {
    return {"lidar PPS", bad, "no position packet came",
            "is the position port (8308 by default) open to this host?"};
  }
  switch (seen.clock->pps) {
    case PpsState::kLocked:
      return {"lidar PPS", seen.clock->utc_valid ? Verdict::kOk : Verdict::kWarn,
              seen.clock->utc_valid ? "locked, UTC accepted" : "locked, but no UTC accepted",
              seen.clock->utc_valid ? "" : "send $GPRMC with status A after each pulse"};
    case PpsState::kSynchronizing:
      return {"lidar PPS", bad, "synchronizing: pulses come, no time is accepted",
              "wait ten seconds; then check the serial line: RS-232 polarity, 9600 baud, $GPRMC"};
    case PpsState::kError:
      return {"lidar PPS", bad, "error", "pulses are irregular: check the source of PPS"};
    default:
      return {"lidar PPS", bad, "absent",
              wanted ? "no pulse reaches the sensor: check wiring and level (above 3 V)"
                     : "its clock is estimated from arrivals, to some 0.3 ms; wire PPS for better"};
  }
}

}  // namespace

LidarObservation observe_lidar(Lidar& lidar, LidarDecoder& decoder,
                               std::chrono::nanoseconds duration, const Now& now,
                               const EventSink& sink) {
  LidarObservation seen;
  if (auto started = lidar.start(); !started) {
    seen.error = started.error().message;
    return seen;
  }
  const HostTime end = now() + duration;
  std::optional<HostTime> first;
  HostTime last;
  std::uint64_t packets = 0;
  DecodedPacket decoded;
  for (HostTime time = now(); time < end; time = now()) {
    const auto message = lidar.read(end - time);
    if (!message) continue;
    if (sink) std::visit([&](const auto& packet) { sink(packet); }, *message);
    if (const auto* packet = std::get_if<LidarPacket>(&*message)) {
      if (!first) first = packet->arrival;
      last = packet->arrival;
      ++packets;
      decoder.decode(*packet, decoded);
    } else if (auto report = decoder.decode(std::get<PositionPacket>(*message))) {
      seen.clock = report;
    }
  }
  if (packets > 1 && last > *first) {
    seen.packets_per_s = static_cast<double>(packets - 1) / to_seconds(last - *first);
  }
  seen.counters = lidar.counters();
  seen.decoded = decoder.counters();
  lidar.stop();
  return seen;
}

std::vector<Check> lidar_checks(const LidarObservation& seen, const RigConfig& rig) {
  std::vector<Check> checks{found(seen, rig.lidar)};
  if (!seen.error.empty() || seen.counters.packets == 0) return checks;
  checks.push_back(rate(seen, rig.lidar));
  checks.push_back(losses(seen));
  checks.push_back(pps(seen, rig.trigger));
  return checks;
}

}  // namespace sparsight
