#include "drivers/simulated/edge_stream.h"

#include <algorithm>
#include <cstdint>

namespace sparsight::simulated {
namespace {

constexpr Elapsed kPulseWidth = std::chrono::milliseconds(50);

}  // namespace

EdgeStream::EdgeStream(const SimulationOptions& options, const CameraClock& camera,
                       const PulseClock& pulses, const FaultPlan& faults) {
  std::uint64_t number = 0;
  const auto add = [&](EdgeLine line, bool rising, Elapsed at) {
    ++number;
    if (faults.away(DeviceKind::kTrigger, at) || faults.loses_edge(number)) return;
    edges_.push_back({line, rising, options.start + at + edge_latency(options.seed, number)});
  };
  for (std::uint64_t frame = 0;; ++frame) {
    const Elapsed exposed = camera.frame(frame).exposed;
    if (exposed + options.exposure > options.duration) break;
    // The camera drives this line: without it there are no edges.
    if (faults.away(DeviceKind::kCamera, exposed)) continue;
    add(EdgeLine::kExposure, true, exposed);
    add(EdgeLine::kExposure, false, exposed + options.exposure);
  }
  for (std::int64_t pulse = 0; options.pps; ++pulse) {
    const Elapsed at = pulses.pulse(pulse);
    if (at + kPulseWidth > options.duration) break;
    add(EdgeLine::kPps, true, at);
    add(EdgeLine::kPps, false, at + kPulseWidth);
  }
  std::ranges::stable_sort(edges_, {}, &Edge::time);
}

std::optional<HostTime> EdgeStream::peek() const {
  if (next_ >= edges_.size()) return std::nullopt;
  return edges_[next_].time;
}

StateStream::StateStream(const SimulationOptions& options) {
  for (const SimulatedFaults::Away& away : options.faults.away) {
    if (away.from >= options.duration) continue;
    changes_.push_back({away.device, DeviceState::kGone, options.start + away.from});
    if (away.from + away.lasting >= options.duration) continue;
    changes_.push_back(
        {away.device, DeviceState::kStreaming, options.start + away.from + away.lasting});
  }
  std::ranges::stable_sort(changes_, {}, &DeviceStateChange::at);
}

std::optional<HostTime> StateStream::peek() const {
  if (next_ >= changes_.size()) return std::nullopt;
  return changes_[next_].at;
}

}  // namespace sparsight::simulated
