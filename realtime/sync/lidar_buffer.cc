#include "realtime/sync/lidar_buffer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

constexpr std::size_t kMostRings = 128;
// How well the turn's duration is known from one packet; within it azimuths decide.
constexpr double kTurnTolerance = 0.05;

float wrapped_180(float degrees) { return std::remainder(degrees, 360.0F); }

nanoseconds scaled(nanoseconds duration, double factor) {
  return nanoseconds(std::llround(static_cast<double>(duration.count()) * factor));
}

}  // namespace

// The last turn of the head before `end`, the firing that the newest packet ends with.
struct LidarBuffer::Turn {
  std::size_t newest;  // ages, in packets
  std::size_t oldest;
  bool whole;
  SensorTime end;
  SensorTime surely_since;   // firings from here on belong to the turn,
  SensorTime perhaps_since;  // of those between, the ones ahead of the end's azimuth
  float end_azimuth_deg;

  bool contains(const TimedReturn& r) const {
    return r.fired > surely_since ||
           (r.fired > perhaps_since && wrapped_180(r.azimuth_deg - end_azimuth_deg) > 0.0F);
  }
};

LidarBuffer::LidarBuffer(const LidarBufferConfig& config)
    : config_(config), ring_(std::max<std::size_t>(1, config.packets)) {}

void LidarBuffer::add(DecodedPacket& packet) {
  DecodedPacket& slot = ring_[added_++ % ring_.size()];
  std::swap(slot, packet);
}

const DecodedPacket& LidarBuffer::from_newest(std::size_t age) const {
  return ring_[(added_ - 1 - age) % ring_.size()];
}

// From a packet's first firing to the next packet's, in which the head turns by turned_deg.
nanoseconds LidarBuffer::length_of(std::size_t age) const {
  const DecodedPacket& packet = from_newest(age);
  const nanoseconds firing = packet.last_firing - packet.first_firing;
  if (age + 1 >= std::min(added_, ring_.size())) return firing;
  const DecodedPacket& before = from_newest(age + 1);
  const nanoseconds step =
      (packet.first_firing - before.first_firing) / (packet.lost_before + std::int64_t{1});
  return before.epoch == packet.epoch && step > firing && step < firing * 11 / 10 ? step : firing;
}

LidarBuffer::Turn LidarBuffer::turn_before(std::size_t newest) const {
  const DecodedPacket& last = from_newest(newest);
  const nanoseconds length = length_of(newest);
  nanoseconds period = config_.longest_turn;
  if (last.turned_deg > 0.0) {
    period = std::min(period, scaled(length, 360.0 / last.turned_deg));
  }
  Turn turn{.newest = newest, .oldest = newest, .whole = false, .end = last.last_firing};
  turn.surely_since = turn.end - scaled(period, 1.0 - kTurnTolerance);
  turn.perhaps_since = turn.end - scaled(period, 1.0 + kTurnTolerance);
  const std::size_t known = std::min(added_, ring_.size());
  for (std::size_t age = newest; age < known; ++age) {
    const DecodedPacket& packet = from_newest(age);
    if (packet.epoch != last.epoch) break;
    turn.whole = packet.first_firing <= turn.perhaps_since;
    if (packet.last_firing <= turn.perhaps_since) break;
    turn.oldest = age;
  }
  // The azimuth of the end, from the newest return.
  for (std::size_t age = newest; age <= turn.oldest; ++age) {
    if (from_newest(age).returns.empty()) continue;
    const TimedReturn& r = from_newest(age).returns.back();
    const double turns = to_seconds(turn.end - r.fired) / to_seconds(period);
    turn.end_azimuth_deg = r.azimuth_deg + static_cast<float>(360.0 * turns);
    break;
  }
  return turn;
}

template <typename Visit>
void LidarBuffer::for_each(const Turn& turn, Visit&& visit) const {
  for (std::size_t age = turn.oldest + 1; age-- > turn.newest;) {
    const DecodedPacket& packet = from_newest(age);
    const bool inside = packet.first_firing > turn.surely_since;
    for (const TimedReturn& r : packet.returns) {
      if (r.ring < kMostRings && (inside || turn.contains(r))) visit(r);
    }
  }
}

SweepOutcome LidarBuffer::sweep(HostTime ready, const ClockLine& clock, HostTime exposure,
                                Sweep& out) const {
  out.returns.clear();
  out.motion_compensated = false;
  const std::size_t known = std::min(added_, ring_.size());
  std::size_t newest = 0;
  while (newest < known && from_newest(newest).arrival > ready) ++newest;
  if (newest == known) return SweepOutcome::kNoPackets;
  const Turn turn = turn_before(newest);
  const nanoseconds end_from_exposure = clock.at(turn.end) - exposure;
  // What is not near the exposure is of no use, and its time would not fit the sweep's 32 bits.
  if (std::chrono::abs(end_from_exposure) > config_.oldest + config_.longest_turn ||
      end_from_exposure < -config_.oldest) {
    return SweepOutcome::kTooOld;
  }
  std::array<std::size_t, kMostRings + 1> next{};  // where the ring's next return goes
  for_each(turn, [&](const TimedReturn& r) { ++next[r.ring + std::size_t{1}]; });
  for (std::size_t ring = 1; ring <= kMostRings; ++ring) next[ring] += next[ring - 1];
  out.returns.resize(next[kMostRings]);
  for_each(turn, [&](const TimedReturn& r) {
    const nanoseconds before_end = turn.end - r.fired;
    const nanoseconds from_exposure = end_from_exposure - scaled(before_end, clock.rate);
    out.returns[next[r.ring]++] = {
        .p_lidar = r.p_lidar,
        .intensity = r.intensity,
        .from_exposure_ns = static_cast<std::int32_t>(from_exposure.count()),
        .ring = r.ring};
  });
  return turn.whole ? SweepOutcome::kWhole : SweepOutcome::kPartial;
}

}  // namespace sparsight
