#include "drivers/simulated/lidar_scanner.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "drivers/gpio/nmea.h"
#include "drivers/simulated/random.h"
#include "drivers/vlp16/vlp16_geometry.h"

namespace sparsight::simulated {
namespace {

constexpr float kNearestM = 0.45F;
constexpr float kFarthestM = 105.0F;
// The beam is so wide where it leaves, and spreads.
constexpr float kBeamM = 0.0095F;
constexpr float kSpreadRad = 0.003F;
constexpr int kApart2mm = 500;
// On the wire at 100 Mbit/s: 1248 and 554 bytes.
constexpr Elapsed kDataOnWire{99'840};
constexpr Elapsed kPositionOnWire{44'320};

// Of the network and the kernel: never less than a floor, sometimes much more.
Elapsed network_delay(Random& random) {
  const double late = random.chance(0.004) ? random.uniform(0.0, 2e-3) : 0.0;
  return Elapsed{static_cast<std::int64_t>(1e9 * (45e-6 + random.exponential(35e-6) + late))};
}

constexpr std::chrono::sys_days kDay = std::chrono::June / 15 / 2026;

}  // namespace

LidarScanner::LidarScanner(const World& world, const LidarClock& clock, const PulseClock& pulses,
                           const SimulationOptions& options, PoseAt pose)
    : world_(world), clock_(clock), pulses_(pulses), options_(options), pose_(std::move(pose)) {}

Ray LidarScanner::beam(std::uint64_t packet, std::size_t sequence, std::size_t laser) const {
  const Elapsed fired = clock_.firing(packet, firing_offset(sequence, laser).count());
  const Eigen::Isometry3d T_world_lidar = pose_(fired);
  const LaserPlacement& placement = kVlp16LaserTable[laser];
  const double azimuth = clock_.azimuth_deg(fired) * M_PI / 180.0;
  const double elevation = placement.elevation_deg * M_PI / 180.0;
  const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                  -std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  const Eigen::Vector3d origin(0.0, 0.0, placement.vertical_offset_mm * 1e-3);
  return {(T_world_lidar * origin).cast<float>(),
          (T_world_lidar.linear() * direction).cast<float>()};
}

float LidarScanner::reflectivity(const Ray& ray, const Hit& hit) const {
  const Material& material = world_.material_of(hit.panel);
  const auto nominal = static_cast<float>(material.reflectivity);
  if (material.reflectivity > 100) return nominal;
  // Dark print gives back less.
  const PanelFrame& frame = world_.frame(hit.panel);
  const Eigen::Vector3f at = ray.origin + hit.distance * ray.direction - frame.origin;
  const float spot = kBeamM + kSpreadRad * hit.distance;
  const float albedo =
      world_.scene().library.albedo(material, {at.dot(frame.right), at.dot(frame.up)}, frame.offset,
                                    {Eigen::Vector2f(spot, 0.0F), Eigen::Vector2f(0.0F, spot)});
  return std::clamp(nominal * (0.55F + 0.9F * albedo), 1.0F, 100.0F);
}

LidarScanner::Echo LidarScanner::measure(const Ray& ray, const Hit& hit, Random& random) const {
  // The same number of draws whatever is hit, so that one change does not shift all that follow.
  const double noise = std::clamp(random.gaussian(), -3.0, 3.0) * options_.range_noise_m;
  const double luck = random.unit();
  const double tone = random.uniform(-1.5, 1.5);
  if (!hit.any() || hit.distance < kNearestM) return {};
  const PanelFrame& frame = world_.frame(hit.panel);
  const float cosine = std::abs(ray.direction.dot(frame.normal));
  const float reflected = reflectivity(ray, hit);
  // A tenth of diffuse reflection is seen to 100 m; light falls off with the square.
  const double reach = 100.0 * std::sqrt(reflected * cosine / 10.0);
  const double lost = world_.material_of(hit.panel).dropout + (cosine < 0.05F ? 0.3 : 0.0);
  if (hit.distance > reach || luck < lost) return {};
  const double range = std::max(0.0, hit.distance + noise);
  return {static_cast<std::uint16_t>(std::lround(range / kVlp16DistanceUnitM)),
          static_cast<std::uint8_t>(std::clamp(std::lround(reflected + tone), 1L, 255L)),
          reflected * cosine / std::max(1.0F, hit.distance * hit.distance)};
}

LidarScanner::Echoes LidarScanner::measure_all(const Ray& middle, Random& random) const {
  // Looks at the middle and at four places half-way to the border.
  constexpr std::array<std::array<float, 2>, 5> kPlaces{{{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  const Eigen::Vector3f right = middle.direction.unitOrthogonal();
  const Eigen::Vector3f up = middle.direction.cross(right);
  std::array<Echo, kPlaces.size()> looks;
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const Eigen::Vector3f aside = kPlaces[i][0] * right + kPlaces[i][1] * up;
    const Ray ray{middle.origin + 0.25F * kBeamM * aside,
                  (middle.direction + 0.25F * kSpreadRad * aside).normalized()};
    looks[i] = measure(ray, world_.cast(ray, 0.05F, kFarthestM), random);
  }
  // What is less than a metre apart is one echo: of its strongest part, as strong
  // as all of it.
  std::ranges::sort(looks, {}, &Echo::distance_2mm);
  std::vector<Echo> echoes;
  std::uint16_t before = 0;
  float strongest_part = 0.0F;
  for (const Echo& look : looks) {
    if (look.distance_2mm == 0) continue;
    if (echoes.empty() || look.distance_2mm > before + kApart2mm) {
      echoes.push_back({});
      strongest_part = 0.0F;
    }
    before = look.distance_2mm;
    Echo& echo = echoes.back();
    const float strength = echo.strength + look.strength;
    if (look.strength > strongest_part) echo = look;
    strongest_part = std::max(strongest_part, look.strength);
    echo.strength = strength;
  }
  if (echoes.empty()) return {};
  const Echo last = echoes.back();
  std::ranges::sort(echoes, std::greater<>(), &Echo::strength);
  const bool last_is_strongest = echoes.front().distance_2mm == last.distance_2mm;
  return {last, last_is_strongest && echoes.size() > 1 ? echoes[1] : echoes.front()};
}

// One firing of all lasers, in the mode's one or two ways to tell it.
void LidarScanner::fire(std::uint64_t packet, std::size_t sequence, FiringSequence& last,
                        FiringSequence& other, Random& random) const {
  const Elapsed first = clock_.firing(packet, firing_offset(sequence, 0).count());
  const double turned = std::fmod(clock_.azimuth_deg(first), 360.0);
  last.azimuth_centideg = static_cast<std::uint16_t>(std::lround(turned * 100.0) % 36000);
  other.azimuth_centideg = last.azimuth_centideg;
  for (std::size_t laser = 0; laser < kVlp16Lasers; ++laser) {
    const Ray ray = beam(packet, sequence, laser);
    Echoes echoes;
    if (options_.return_mode == ReturnMode::kStrongest) {
      echoes.last = measure(ray, world_.cast(ray, 0.05F, kFarthestM), random);
    } else {
      echoes = measure_all(ray, random);
    }
    last.distance_2mm[laser] = echoes.last.distance_2mm;
    last.reflectivity[laser] = echoes.last.reflectivity;
    other.distance_2mm[laser] = echoes.other.distance_2mm;
    other.reflectivity[laser] = echoes.other.reflectivity;
  }
}

LidarPacket LidarScanner::packet(std::uint64_t number) const {
  Random random(options_.seed, 0xda7a, number);
  std::array<FiringSequence, kVlp16SequencesPerPacket> sequences;
  if (options_.return_mode == ReturnMode::kDual) {
    for (std::size_t s = 0; s < sequences.size() / 2; ++s) {
      const std::size_t at = s / 2 * 4 + s % 2;
      fire(number, s, sequences[at], sequences[at + 2], random);
    }
  } else {
    FiringSequence untold;
    for (std::size_t s = 0; s < sequences.size(); ++s) {
      fire(number, s, sequences[s], untold, random);
    }
  }
  LidarPacket packet;
  const Elapsed start = clock_.packet_start(number);
  packet.payload =
      write_data_packet(sequences, clock_.microseconds_past_hour(start), options_.return_mode);
  // A packet leaves when it is full.
  packet.arrival = HostTime{clock_.packet_start(number + 1) + kDataOnWire + network_delay(random)};
  return packet;
}

PositionPacket LidarScanner::position(std::uint64_t after_packet) const {
  Random random(options_.seed, 0x9051, after_packet);
  const Elapsed made = clock_.packet_start(after_packet + 1) + Elapsed{310'000};
  PositionPacket packet;
  const std::int64_t pulse = pulses_.last_before(made);
  packet.payload = write_position_packet(
      clock_.microseconds_past_hour(made), options_.pps ? PpsState::kLocked : PpsState::kAbsent,
      options_.pps ? gprmc(kDay + std::chrono::seconds(pulses_.second_of_day(pulse)))
                   : std::string());
  packet.arrival = HostTime{made + kPositionOnWire + network_delay(random)};
  return packet;
}

}  // namespace sparsight::simulated
