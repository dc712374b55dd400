#include "drivers/vlp16/sweep_assembler.h"

#include <algorithm>
#include <cmath>

#include "drivers/vlp16/vlp16_geometry.h"

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

double wrapped_turn(double degrees) {
  const double turn = std::fmod(degrees, 360.0);
  return turn < 0.0 ? turn + 360.0 : turn;
}

// No head turns faster than 1200 rpm: a packet that seems to has the dead arc of a narrowed field
// of view in it.
constexpr double kMaxRateDegPerNs = 1.25 * 20.0 * 360.0 * 1e-9;

// A firing so close before the seam lies on it: the azimuth of a return is rounded to a float,
// which must not put a packet's first firing before the packet.
constexpr double kOnSeamDeg = 1e-4;

std::int64_t sequences_of(const DecodedPacket& packet) {
  return (packet.last_firing - packet.first_firing) / kVlp16SequenceInterval + 1;
}

nanoseconds duration_of(const DecodedPacket& packet) {
  return sequences_of(packet) * kVlp16SequenceInterval;
}

// How many firings lie before `share` of the packet's turn: of sixteen in each sequence, the last
// fires when the sequence is five eighths over.
std::uint64_t firings_before(double share, const DecodedPacket& packet) {
  const double sequence = share * static_cast<double>(sequences_of(packet));
  const double whole = std::floor(sequence);
  const double firing =
      std::ceil((sequence - whole) * kVlp16SequenceInterval / nanoseconds(kVlp16FiringInterval));
  return static_cast<std::uint64_t>(whole) * kVlp16Lasers +
         std::min<std::uint64_t>(static_cast<std::uint64_t>(firing), kVlp16Lasers);
}

nanoseconds share_of(nanoseconds duration, double share) {
  return nanoseconds(std::llround(share * static_cast<double>(duration.count())));
}

}  // namespace

SweepAssembler::SweepAssembler(const SweepAssemblerConfig& config) : config_(config) {}

void SweepAssembler::add(const DecodedPacket& packet) {
  if (gathering_ && packet.epoch != current_.epoch) {
    finish(Revolution::End::kClockJump, packet_end_);
    gathering_ = false;
  }
  double azimuth = packet.first_azimuth_deg;
  if (!gathering_) {
    begin_at_packet(packet);
  } else {
    azimuth = unwrapped(packet);
    pass_seam_between_packets(azimuth, packet.first_firing);
    if (packet.first_firing - current_.begin >= config_.max_duration) {
      finish(Revolution::End::kTime, packet_end_);
      current_.begin = packet.first_firing;
      from_seam_ = false;
    }
  }
  add_firings(packet, azimuth);
  packet_end_ = packet.first_firing + duration_of(packet);
  before_.azimuth_deg = azimuth;
  before_.time = packet.first_firing;
  const double rate = packet.turned_deg / static_cast<double>(duration_of(packet).count());
  if (rate < kMaxRateDegPerNs) before_.rate_deg_per_ns = rate;
}

void SweepAssembler::begin_at_packet(const DecodedPacket& packet) {
  gathering_ = true;
  from_seam_ = false;
  current_ = {};
  current_.epoch = packet.epoch;
  current_.begin = packet.first_firing;
  const double azimuth = packet.first_azimuth_deg;
  next_seam_deg_ = azimuth + wrapped_turn(config_.seam_azimuth_deg - azimuth);
}

// The turns that packets were missing for are counted by time and rate.
double SweepAssembler::unwrapped(const DecodedPacket& packet) const {
  const auto gap = static_cast<double>((packet.first_firing - before_.time).count());
  const double expected = before_.azimuth_deg + before_.rate_deg_per_ns * gap;
  return packet.first_azimuth_deg +
         360.0 * std::round((expected - packet.first_azimuth_deg) / 360.0);
}

void SweepAssembler::pass_seam_between_packets(double azimuth_deg, SensorTime time) {
  if (azimuth_deg < next_seam_deg_) return;
  const double turned = azimuth_deg - before_.azimuth_deg;
  const double share = turned > 0.0 ? (next_seam_deg_ - before_.azimuth_deg) / turned : 1.0;
  pass_seam(before_.time + share_of(time - before_.time, std::clamp(share, 0.0, 1.0)));
  // Several turns may be missing: they make no empty revolutions, but one that begins now.
  const double behind = azimuth_deg - next_seam_deg_;
  if (behind < 0.0) return;
  next_seam_deg_ += 360.0 * (std::floor(behind / 360.0) + 1.0);
  current_.begin = time;
  from_seam_ = false;
}

void SweepAssembler::add_firings(const DecodedPacket& packet, double azimuth_deg) {
  const auto& returns = packet.returns;
  const std::uint64_t firings = static_cast<std::uint64_t>(sequences_of(packet)) * kVlp16Lasers;
  auto begin = returns.begin();
  std::uint64_t counted = 0;
  // More than one only if a packet with a dead arc in it holds more than a turn.
  while (next_seam_deg_ < azimuth_deg + packet.turned_deg) {
    const double to_seam = next_seam_deg_ - azimuth_deg - kOnSeamDeg;
    const double share = std::clamp(to_seam / packet.turned_deg, 0.0, 1.0);
    const auto beyond = std::find_if(begin, returns.end(), [&](const TimedReturn& point) {
      const double turned = point.azimuth_deg - packet.first_azimuth_deg;
      return wrapped_turn(turned + kOnSeamDeg) - kOnSeamDeg >= to_seam;
    });
    const std::uint64_t before = std::max(counted, firings_before(share, packet));
    current_.returns.insert(current_.returns.end(), begin, beyond);
    current_.received_firings += before - counted;
    current_.arrival = packet.arrival;
    pass_seam(packet.first_firing + share_of(duration_of(packet), share));
    begin = beyond;
    counted = before;
  }
  current_.returns.insert(current_.returns.end(), begin, returns.end());
  current_.received_firings += firings - counted;
  current_.arrival = packet.arrival;
}

void SweepAssembler::pass_seam(SensorTime when) {
  finish(Revolution::End::kSeam, when);
  current_.begin = when;
  from_seam_ = true;
  next_seam_deg_ += 360.0;
}

void SweepAssembler::finish(Revolution::End end, SensorTime when) {
  current_.end = when;
  current_.ended_by = end;
  current_.whole = from_seam_ && end == Revolution::End::kSeam;
  const auto sequences = std::chrono::duration<double>(current_.end - current_.begin) /
                         std::chrono::duration<double>(kVlp16SequenceInterval);
  current_.expected_firings =
      static_cast<std::uint64_t>(std::llround(kVlp16Lasers * std::max(0.0, sequences)));
  const std::size_t usual_returns = current_.returns.size();
  const std::uint32_t epoch = current_.epoch;
  const HostTime arrival = current_.arrival;
  // The seam may be where a stream begins: nothing was gathered before it.
  if (current_.received_firings > 0 || !current_.returns.empty()) {
    finished_.push_back(std::move(current_));
  }
  current_ = {};
  current_.returns.reserve(usual_returns + usual_returns / 8);
  current_.epoch = epoch;
  current_.arrival = arrival;
}

std::optional<Revolution> SweepAssembler::take() {
  if (finished_.empty()) return std::nullopt;
  Revolution revolution = std::move(finished_.front());
  finished_.pop_front();
  return revolution;
}

void SweepAssembler::flush() {
  if (gathering_) finish(Revolution::End::kFlush, packet_end_);
  gathering_ = false;
}

}  // namespace sparsight
