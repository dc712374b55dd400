#include "drivers/simulated/rig_clocks.h"

#include <cmath>

#include "drivers/simulated/random.h"
#include "drivers/vlp16/vlp16_geometry.h"

namespace sparsight::simulated {
namespace {

constexpr double kCameraDriftPpm = -14.0;
constexpr double kReadoutS = 0.0105;  // 600 lines of a sensor that can do 90 Hz
constexpr std::int64_t kHourUs = 3'600'000'000;

Elapsed from_seconds(double seconds) {
  return Elapsed{static_cast<std::int64_t>(std::llround(seconds * 1e9))};
}

double in_seconds(Elapsed elapsed) { return static_cast<double>(elapsed.count()) * 1e-9; }

}  // namespace

CameraClock::CameraClock(const SimulationOptions& options)
    : options_(options), period_s_((1.0 + kCameraDriftPpm * 1e-6) / options.rate_hz) {
  Random random(options.seed, 0xca3e4a);
  phase_s_ = random.uniform(0.1, 0.9) * period_s_;
}

FrameTimes CameraClock::frame(std::uint64_t number) const {
  Random random(options_.seed, 0xca3e4b, number);
  FrameTimes times;
  times.exposed = from_seconds(phase_s_ + static_cast<double>(number) * period_s_);
  times.middle = times.exposed + Elapsed(options_.exposure) / 2;
  // Stamped when the last byte has come in, taken when the reader wakes up.
  times.driver = times.exposed + options_.exposure +
                 from_seconds(kReadoutS + 0.0002 + random.exponential(0.0003));
  times.arrival =
      times.driver + from_seconds(0.0001 + std::fmin(random.exponential(0.0008), 0.008));
  return times;
}

PulseClock::PulseClock(std::uint64_t seed) {
  Random random(seed, 0x995);
  phase_ = from_seconds(random.uniform(0.1, 0.9));
  first_second_ = 8 * 3600 + random.index(9 * 3600);
}

Elapsed PulseClock::pulse(std::int64_t number) const {
  return phase_ + number * Elapsed{1'000'000'000};
}

std::int64_t PulseClock::last_before(Elapsed at) const {
  return static_cast<std::int64_t>(std::floor(in_seconds(at - phase_)));
}

Elapsed edge_latency(std::uint64_t seed, std::uint64_t number) {
  Random random(seed, 0x1a7, number);
  const double tail = random.chance(0.01) ? random.uniform(0.0, 60e-6) : 0.0;
  return from_seconds(3e-6 + 4e-6 * std::abs(random.gaussian()) + tail);
}

Elapsed packet_interval(const SimulationOptions& options) {
  return options.return_mode == ReturnMode::kDual ? kVlp16DualPacketInterval : kVlp16PacketInterval;
}

LidarClock::LidarClock(const SimulationOptions& options, const FaultPlan& faults,
                       const PulseClock& pulses)
    : options_(options),
      faults_(faults),
      pulses_(pulses),
      rate_(1.0 + options.lidar_clock_drift_ppm * 1e-6) {
  Random random(options.seed, 0x11da4);
  phase_ = from_seconds(random.uniform(0.0, 0.001));
  first_azimuth_deg_ = random.uniform(0.0, 360.0);
  turns_per_s_ = 10.0 * (1.0 + random.uniform(-3e-4, 3e-4));
  free_start_s_ = random.uniform(100.0, 3400.0);
}

Elapsed LidarClock::packet_start(std::uint64_t packet) const { return firing(packet, 0); }

Elapsed LidarClock::firing(std::uint64_t packet, std::int64_t offset_ns) const {
  const std::int64_t ticks =
      static_cast<std::int64_t>(packet) * packet_interval(options_).count() + offset_ns;
  return phase_ +
         Elapsed{static_cast<std::int64_t>(std::llround(static_cast<double>(ticks) / rate_))};
}

double LidarClock::azimuth_deg(Elapsed at) const {
  const double t = in_seconds(at);
  return first_azimuth_deg_ + 360.0 * turns_per_s_ * t + 0.08 * std::sin(2.0 * M_PI * 0.9 * t);
}

std::uint32_t LidarClock::microseconds_past_hour(Elapsed at) const {
  double seconds = free_start_s_ + in_seconds(at) * rate_;
  if (options_.pps) {
    // Locked: each pulse sets the fraction of a second back to zero; between, its own rate counts.
    const std::int64_t pulse = pulses_.last_before(at);
    seconds = static_cast<double>(pulses_.second_of_day(pulse)) +
              in_seconds(at - pulses_.pulse(pulse)) * rate_;
  }
  const auto us =
      static_cast<std::int64_t>(std::floor((seconds + in_seconds(faults_.clock_jump(at))) * 1e6));
  return static_cast<std::uint32_t>(((us % kHourUs) + kHourUs) % kHourUs);
}

}  // namespace sparsight::simulated
