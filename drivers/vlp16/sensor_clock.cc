#include "drivers/vlp16/sensor_clock.h"

#include <algorithm>

namespace sparsight {
namespace {

using std::chrono::nanoseconds;
using namespace std::chrono_literals;

constexpr nanoseconds kHour = 1h;

// Networks swap neighbours, packets 0.7 or 1.3 ms apart, and rarely more.
constexpr nanoseconds kMaxReordering = 50ms;
// So many packets in a row that are all late belong to a clock that was set back a little: PPS lock
// moves the part below a second by any amount.
constexpr int kBehindMeansJump = 8;
constexpr nanoseconds kMaxStepBehind = 5ms;

// The kernel's receive stamps may be late by so much, never early.
constexpr nanoseconds kMaxArrivalDelay = 20ms;
// The sensor says that less time has gone by than the host: drift of the one over the other, or a
// very late stamp. More than this, and the sensor was restarted meanwhile.
constexpr nanoseconds kMaxHeldBack = 1s;
// Without arrivals: as much loss is believed.
constexpr nanoseconds kMaxBlindGap = 1s;
// Position packets are put together up to some milliseconds before or after the data around them.
constexpr nanoseconds kMaxPlacement = 50ms;

bool known(HostTime arrival) { return arrival != HostTime{}; }

SensorTime within_hour(std::uint32_t microseconds_past_hour) {
  return SensorTime(std::chrono::microseconds(microseconds_past_hour));
}

// Modulo one hour, so that the roll-over needs no case of its own, nor do the stamps beyond
// 3 599 999 999 that some firmware sends before it rolls over.
SensorTime nearest(std::uint32_t microseconds_past_hour, SensorTime to) {
  const nanoseconds apart = within_hour(microseconds_past_hour) - to;
  nanoseconds step = apart % kHour;
  if (step >= kHour / 2) step -= kHour;
  if (step < -kHour / 2) step += kHour;
  return to + step;
}

}  // namespace

SensorTimeline::Step SensorTimeline::advance(std::uint32_t microseconds_past_hour,
                                             HostTime arrival) {
  if (!started_) {
    started_ = true;
    now_ = within_hour(microseconds_past_hour);
    arrival_ = arrival;
    return Step::kForward;
  }
  const SensorTime stamp = nearest(microseconds_past_hour, now_);
  const nanoseconds step = stamp - now_;
  if (step <= 0ns && step > -kMaxReordering) {
    if (!set_back(stamp)) return Step::kReordered;
    return start_epoch(microseconds_past_hour, arrival);
  }
  const nanoseconds ahead_of_host = step - std::max(arrival - arrival_, 0ns);
  const bool fits = known(arrival) && known(arrival_)
                        ? ahead_of_host <= kMaxArrivalDelay && ahead_of_host >= -kMaxHeldBack
                        : step <= kMaxBlindGap;
  if (step < 0ns || !fits) return start_epoch(microseconds_past_hour, arrival);
  now_ = stamp;
  arrival_ = arrival;
  behind_in_a_row_ = 0;
  return Step::kForward;
}

// Whether a stamp behind the last one is one too many to be a late packet's.
bool SensorTimeline::set_back(SensorTime stamp) {
  const nanoseconds on = stamp - last_behind_;
  const bool follows = behind_in_a_row_ > 0 && on > 0ns && on < kMaxStepBehind;
  behind_in_a_row_ = follows ? behind_in_a_row_ + 1 : 1;
  last_behind_ = stamp;
  return behind_in_a_row_ >= kBehindMeansJump;
}

SensorTimeline::Step SensorTimeline::start_epoch(std::uint32_t microseconds_past_hour,
                                                 HostTime arrival) {
  ++epoch_;
  now_ = within_hour(microseconds_past_hour);
  arrival_ = arrival;
  behind_in_a_row_ = 0;
  return Step::kJump;
}

std::optional<SensorTime> SensorTimeline::place(std::uint32_t microseconds_past_hour,
                                                HostTime arrival) const {
  if (!started_) return within_hour(microseconds_past_hour);
  const bool timed = known(arrival) && known(arrival_);
  const SensorTime expected = timed ? now_ + (arrival - arrival_) : now_;
  const SensorTime stamp = nearest(microseconds_past_hour, expected);
  if (std::chrono::abs(stamp - expected) > (timed ? kMaxPlacement : kMaxBlindGap)) {
    return std::nullopt;
  }
  return stamp;
}

std::uint32_t packets_lost(nanoseconds gap, nanoseconds packet_interval) {
  const auto packets = (gap + packet_interval / 2) / packet_interval;
  return packets > 1 ? static_cast<std::uint32_t>(packets - 1) : 0;
}

}  // namespace sparsight
