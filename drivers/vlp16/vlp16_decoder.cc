#include "drivers/vlp16/vlp16_decoder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "drivers/vlp16/position_packet.h"

namespace sparsight {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;

// The range limits in the sensor's unit: comparing integers decides the same for every platform.
std::uint16_t at_least(double range_m) {
  // 0 is no return, whatever the configuration says.
  return static_cast<std::uint16_t>(
      std::clamp(std::ceil(range_m / kVlp16DistanceUnitM - 1e-6), 1.0, 65535.0));
}
std::uint16_t at_most(double range_m) {
  return static_cast<std::uint16_t>(
      std::clamp(std::floor(range_m / kVlp16DistanceUnitM + 1e-6), 0.0, 65535.0));
}

float azimuth_of(double degrees) {
  if (degrees >= 360.0) degrees -= 360.0;
  if (degrees < 0.0) degrees += 360.0;
  const auto rounded = static_cast<float>(degrees);
  return rounded < 360.0F ? rounded : 0.0F;  // the nearest float of 359.99999 is 360
}

std::chrono::nanoseconds interval_of(const DataPacket& packet) {
  return static_cast<std::int64_t>(packet.sequence_count) * kVlp16SequenceInterval;
}

}  // namespace

Vlp16Decoder::Vlp16Decoder(const LidarConfig& config)
    : vlp16_(beams_of(kVlp16LaserTable, config)),
      hi_res_(beams_of(kVlp16HiResLaserTable, config)),
      min_distance_2mm_(at_least(config.min_range_m)),
      max_distance_2mm_(at_most(config.max_range_m)) {}

Vlp16Decoder::Beams Vlp16Decoder::beams_of(const LaserTable& nominal, const LidarConfig& config) {
  Beams beams;
  for (std::size_t k = 0; k < kVlp16Lasers; ++k) {
    const LaserPlacement& laser = nominal[k];
    const double elevation =
        config.elevation_deg ? (*config.elevation_deg)[laser.ring] : laser.elevation_deg;
    const double offset_mm = config.vertical_offset_mm ? (*config.vertical_offset_mm)[laser.ring]
                                                       : laser.vertical_offset_mm;
    beams[k] = {std::cos(elevation * kRadiansPerDegree), std::sin(elevation * kRadiansPerDegree),
                offset_mm * 1e-3, laser.ring};
  }
  return beams;
}

bool Vlp16Decoder::decode(const LidarPacket& packet, DecodedPacket& out) {
  if (const auto read = read_data_packet(packet.payload, packet_); !read) {
    ++counters_.refused;
    last_fault_ = read.error();
    return false;
  }
  if (!take_stamp(packet.arrival, out)) return false;
  ++counters_.decoded;
  out.turned_deg = packet_.turned_deg;
  out.first_azimuth_deg = packet_.sequences.front().azimuth_deg;
  add_returns(out);
  return true;
}

bool Vlp16Decoder::take_stamp(HostTime arrival, DecodedPacket& out) {
  const SensorTime before = timeline_.now();
  const auto step = timeline_.advance(packet_.microseconds_past_hour, arrival);
  if (step == SensorTimeline::Step::kReordered) {
    ++counters_.reordered;
    return false;
  }
  out.lost_before = 0;
  if (step == SensorTimeline::Step::kJump) {
    ++counters_.clock_jumps;
  } else if (last_interval_.count() > 0) {
    out.lost_before = packets_lost(timeline_.now() - before, last_interval_);
    counters_.lost += out.lost_before;
  }
  last_interval_ = interval_of(packet_);
  out.arrival = arrival;
  out.first_firing = timeline_.now();
  out.last_firing = out.first_firing + firing_offset(packet_.sequence_count - 1, kVlp16Lasers - 1);
  out.epoch = timeline_.epoch();
  return true;
}

void Vlp16Decoder::add_returns(DecodedPacket& out) const {
  out.returns.clear();
  out.returns.reserve(kVlp16SequencesPerPacket * kVlp16Lasers);
  const Beams& beams = packet_.model == LidarModel::kVlp16 ? vlp16_ : hi_res_;
  for (std::size_t s = 0; s < packet_.sequence_count; ++s) {
    add_sequence(packet_.sequences[s], beams, out.first_firing + firing_offset(s, 0), out.returns);
  }
}

void Vlp16Decoder::add_sequence(const SequenceReading& sequence, const Beams& beams,
                                SensorTime fired, std::vector<TimedReturn>& returns) const {
  double ahead = std::cos(sequence.azimuth_deg * kRadiansPerDegree);
  double right = std::sin(sequence.azimuth_deg * kRadiansPerDegree);
  // The head turns by 0.03 degrees at most between firings: rotating on is exact to 1e-15.
  const double turn = sequence.turn_per_firing_deg * kRadiansPerDegree;
  const double turn_sin = turn - turn * turn * turn / 6.0;
  const double turn_cos = 1.0 - turn * turn / 2.0;
  for (std::size_t k = 0; k < kVlp16Lasers; ++k) {
    for (const Echo& echo : {sequence.echoes[k], sequence.second_echoes[k]}) {
      if (echo.distance_2mm < min_distance_2mm_ || echo.distance_2mm > max_distance_2mm_) continue;
      const Beam& beam = beams[k];
      const double range = echo.distance_2mm * kVlp16DistanceUnitM;
      const double level = range * beam.level;
      TimedReturn& point = returns.emplace_back();
      // Azimuth runs clockwise from ahead; y is to the left.
      point.p_lidar =
          Eigen::Vector3d(level * ahead, -level * right, range * beam.upward + beam.offset_m)
              .cast<float>();
      point.intensity = echo.reflectivity;
      point.azimuth_deg =
          azimuth_of(sequence.azimuth_deg + static_cast<double>(k) * sequence.turn_per_firing_deg);
      point.fired = fired + firing_offset(0, k);
      point.ring = beam.ring;
    }
    const double next = ahead * turn_cos - right * turn_sin;
    right = right * turn_cos + ahead * turn_sin;
    ahead = next;
  }
}

std::optional<LidarClockReport> Vlp16Decoder::decode(const PositionPacket& packet) {
  const auto reading = read_position_packet(packet.payload);
  if (!reading) {
    ++counters_.refused;
    return std::nullopt;
  }
  const auto time = timeline_.place(reading->microseconds_past_hour, packet.arrival);
  if (!time) return std::nullopt;
  return LidarClockReport{packet.arrival, *time, reading->pps, hour_is_utc(*reading)};
}

}  // namespace sparsight
