#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "hal/time.h"

namespace sparsight {

// The sensor stamps with microseconds since the hour, an hour that is UTC's only once PPS and NMEA
// are accepted. This counts on over the hours. Times of two epochs do not compare; each epoch
// starts at what the sensor said, so that a time modulo one hour is always the sensor's own.
// Thread-bound.
class SensorTimeline {
 public:
  enum class Step : std::uint8_t {
    kForward,    // later than before; how much later may mean loss
    kReordered,  // a little earlier than what has already been seen, or the same again
    kJump,       // the clock was set, or the sensor restarted: a new epoch begins here
  };
  // Takes the stamp of the next data packet. The host's clock tells a loss from a jump: after a
  // loss both clocks have moved on alike. A default-constructed arrival counts as unknown.
  Step advance(std::uint32_t microseconds_past_hour, HostTime arrival);

  // The time of a stamp that may lie a little off the data packets' (a position packet's), on the
  // same count. Nothing if it fits neither: the clock has been set since the last data packet.
  std::optional<SensorTime> place(std::uint32_t microseconds_past_hour, HostTime arrival) const;

  SensorTime now() const { return now_; }  // of the last stamp that was not reordered
  std::uint32_t epoch() const { return epoch_; }

 private:
  bool set_back(SensorTime stamp);
  Step start_epoch(std::uint32_t microseconds_past_hour, HostTime arrival);

  bool started_ = false;
  SensorTime now_;
  HostTime arrival_;
  std::uint32_t epoch_ = 0;
  SensorTime last_behind_;
  int behind_in_a_row_ = 0;
};

// Packets missing between two whose first firings lie `gap` apart. Half a packet of tolerance keeps
// rounding to microseconds and the steps of a PPS-disciplined clock from counting.
std::uint32_t packets_lost(std::chrono::nanoseconds gap, std::chrono::nanoseconds packet_interval);

}  // namespace sparsight
