#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "hal/rig_event.h"

namespace sparsight {

struct MadeLidarOptions {
  std::chrono::nanoseconds offset{std::chrono::minutes(23)};  // host minus sensor at the start
  double drift_ppm = 40.0;                                    // how much faster the host counts
  double mean_delay_ns = 600'000;                             // exponential
  double slow_share = 0.01;                                   // take 5 ms more
  double rpm = 600.0;
  bool steered = false;  // locked to PPS: whole seconds are true ones, between them it drifts
  double pps_jitter_ns = 20'000;
  std::size_t rays = 16;
  unsigned seed = 1;
};

// A VLP-16's time line: when each packet is fired by its own clock, and comes by the host's.
class MadeLidar {
 public:
  static constexpr std::chrono::nanoseconds kSequence{55'296};
  static constexpr std::chrono::nanoseconds kFiring{2'304};
  static constexpr int kSequences = 24;
  static constexpr std::chrono::nanoseconds kPacket = kSequences * kSequence;

  explicit MadeLidar(const MadeLidarOptions& options = {})
      : options_(options), random_(options.seed) {}

  // The truth.
  HostTime host_time(SensorTime time) const {
    const double since = static_cast<double>((time - kStart).count());
    if (!options_.steered) {
      return HostTime((time - kStart) + kHostStart + options_.offset +
                      std::chrono::nanoseconds(std::llround(since * options_.drift_ppm * 1e-6)));
    }
    // Whole seconds come every second of the host, the crystal runs on alone between them.
    const auto second = std::chrono::floor<std::chrono::seconds>(time.time_since_epoch());
    const double within = static_cast<double>((time.time_since_epoch() - second).count());
    return HostTime((time - kStart) + kHostStart + options_.offset +
                    std::chrono::nanoseconds(std::llround(within * options_.drift_ppm * 1e-6)));
  }

  DecodedPacket next() {
    DecodedPacket packet;
    packet.first_firing = now_;
    packet.last_firing = now_ + (kSequences - 1) * kSequence + 15 * kFiring;
    packet.turned_deg = turn_of(kPacket);
    packet.epoch = epoch_;
    packet.lost_before = std::exchange(lost_, 0U);
    add_returns(packet);
    now_ += kPacket;
    std::exponential_distribution<double> delay(1.0 / options_.mean_delay_ns);
    HostTime arrival = host_time(packet.last_firing) + std::chrono::nanoseconds(99'840) +
                       std::chrono::nanoseconds(std::llround(delay(random_)));
    if (std::uniform_real_distribution(0.0, 1.0)(random_) < options_.slow_share) {
      arrival += std::chrono::milliseconds(5);
    }
    packet.arrival = last_arrival_ = std::max(arrival, last_arrival_);
    return packet;
  }
  void lose(std::uint32_t packets) {
    lost_ += packets;
    now_ += packets * kPacket;
  }
  // The sensor's clock is set; the decoder takes note, or does not.
  void set_clock(std::chrono::nanoseconds by, bool noticed) {
    options_.offset -= by;
    now_ += by;
    if (noticed) ++epoch_;
  }
  Edge pps(SensorTime second) {
    std::normal_distribution<double> jitter(0.0, options_.pps_jitter_ns);
    return {EdgeLine::kPps, true,
            host_time(second) + std::chrono::nanoseconds(std::llround(jitter(random_)))};
  }
  SensorTime now() const { return now_; }
  float azimuth_at(SensorTime time) const {
    const double turned = turn_of(time - kStart);
    return static_cast<float>(turned - 360.0 * std::floor(turned / 360.0));
  }

  // A made return's point says when it was fired: milliseconds and nanoseconds from the start.
  static Eigen::Vector3f written(SensorTime fired) {
    const std::int64_t ns = (fired - kStart).count();
    return {static_cast<float>(ns / 1'000'000), static_cast<float>(ns % 1'000'000), 0.0F};
  }
  static SensorTime read(const Eigen::Vector3f& p_lidar) {
    return kStart + std::chrono::milliseconds(std::llround(p_lidar.x())) +
           std::chrono::nanoseconds(std::llround(p_lidar.y()));
  }

  static constexpr SensorTime kStart{std::chrono::seconds(700)};
  static constexpr std::chrono::nanoseconds kHostStart{std::chrono::seconds(4000)};

 private:
  double turn_of(std::chrono::nanoseconds time) const {
    return options_.rpm / 60.0 * 360.0 * 1e-9 * static_cast<double>(time.count());
  }
  void add_returns(DecodedPacket& packet) const {
    for (int s = 0; s < kSequences; ++s) {
      for (std::size_t k = 0; k < options_.rays; ++k) {
        TimedReturn& r = packet.returns.emplace_back();
        r.fired = packet.first_firing + s * kSequence + static_cast<std::int64_t>(k) * kFiring;
        r.azimuth_deg = azimuth_at(r.fired);
        r.ring = static_cast<std::uint16_t>(k);
        r.p_lidar = written(r.fired);
      }
    }
  }

  MadeLidarOptions options_;
  std::mt19937 random_;
  SensorTime now_ = kStart;
  HostTime last_arrival_{};
  std::uint32_t lost_ = 0;
  std::uint32_t epoch_ = 0;
};

}  // namespace sparsight
