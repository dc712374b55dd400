#include "realtime/sync/lidar_clock.h"

#include <algorithm>
#include <cmath>

namespace sparsight {
namespace {

using std::chrono::nanoseconds;

constexpr PulseTrainConfig kPpsTrain{.intervals_to_learn = 2, .pulses_in_fit = 8};
constexpr nanoseconds kSecond{1'000'000'000};

nanoseconds root_of_squares(nanoseconds a, nanoseconds b) {
  return nanoseconds(
      std::llround(std::hypot(static_cast<double>(a.count()), static_cast<double>(b.count()))));
}

SensorTime nearest_second(SensorTime time) {
  return SensorTime(std::chrono::round<std::chrono::seconds>(time.time_since_epoch()));
}

}  // namespace

LidarClock::LidarClock(const LidarClockConfig& config)
    : config_(config), envelope_(config.envelope), pulses_(kPpsTrain) {}

void LidarClock::add(const Edge& edge) {
  if (!edge.rising) return;
  pulses_.add(edge.time, nanoseconds(0), false);
  last_pulse_ = edge.time;
}

void LidarClock::add(const LidarClockReport& report) { report_ = report; }

void LidarClock::restart() {
  ++restarts_;
  envelope_.clear();
  mapping_.reset();
}

void LidarClock::add(const DecodedPacket& packet) {
  const bool locked = locked_at(packet.arrival);
  // Locking steps the clock, and a steered clock drifts otherwise than a free one.
  if (begun_ && (packet.epoch != epoch_ || locked != was_locked_)) restart();
  begun_ = true;
  epoch_ = packet.epoch;
  was_locked_ = locked;
  envelope_.add(packet.last_firing, packet.arrival - config_.packet_delay);
  const auto line = envelope_.line();
  if (!line) return;
  mapping_ = locked ? by_pulses(*line, packet.arrival) : std::nullopt;
  source_ = mapping_ ? LidarClockSource::kPps : LidarClockSource::kArrivals;
  if (mapping_) return;
  mapping_ =
      ClockMapping{.line = *line,
                   .uncertainty = root_of_squares(envelope_.uncertainty(), config_.arrival_bias),
                   .quality = StampQuality::kEstimated};
}

bool LidarClock::locked_at(HostTime now) const {
  return report_ && report_->pps == PpsState::kLocked &&
         now - report_->arrival < config_.report_lifetime;
}

std::optional<ClockMapping> LidarClock::by_pulses(const ClockLine& by_arrivals, HostTime now) {
  if (!pulses_.regular() || now - *last_pulse_ > config_.pulse_lifetime) return std::nullopt;
  const nanoseconds period = pulses_.period();
  if (std::chrono::abs(period - kSecond) > kSecond / 1000) return std::nullopt;  // no PPS
  const PulsePlace pulse = pulses_.place_of(pulses_.last_index());
  const SensorTime by_arrival = by_arrivals.sensor_at(pulse.time);
  const SensorTime second = nearest_second(by_arrival);
  if (std::chrono::abs(by_arrival - second) > config_.most_pps_error) {
    ++disagreements_;
    return std::nullopt;
  }
  const double rate = static_cast<double>(period.count()) / static_cast<double>(kSecond.count());
  return ClockMapping{.line = {.sensor = second, .host = pulse.time, .rate = rate},
                      .uncertainty = root_of_squares(pulse.sigma, config_.pps_sawtooth),
                      .quality = StampQuality::kMeasured};
}

LidarClockState LidarClock::state() const {
  LidarClockState state{.source = mapping_ ? source_ : LidarClockSource::kNone,
                        .spread = envelope_.mean_delay(),
                        .epoch = epoch_,
                        .restarts = restarts_ + envelope_.restarts(),
                        .pps = report_ ? report_->pps : PpsState::kAbsent,
                        .pps_edges = pulses_.counters().pulses,
                        .pps_edges_lost = pulses_.counters().lost,
                        .pps_disagreements = disagreements_};
  if (mapping_) {
    state.offset =
        mapping_->line.host.time_since_epoch() - mapping_->line.sensor.time_since_epoch();
    state.drift_ppm = (mapping_->line.rate - 1.0) * 1e6;
    state.uncertainty = mapping_->uncertainty;
  }
  return state;
}

}  // namespace sparsight
