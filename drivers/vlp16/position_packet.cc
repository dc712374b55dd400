#include "drivers/vlp16/position_packet.h"

#include "drivers/vlp16/wire_format.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;

// The sentence names the second of a pulse that is over, by at most the one that it takes to
// arrive and the one until the next; receivers that name the coming second exist as well.
constexpr std::chrono::nanoseconds kMaxSentenceAge = 2500ms;
constexpr std::chrono::nanoseconds kMaxSentenceLead = 1s;

}  // namespace

std::optional<PositionReading> read_position_packet(const std::array<std::uint8_t, 512>& payload) {
  const auto packet = wire::from_bytes<wire::PositionPacket>(payload);
  if (packet.pps_state > static_cast<std::uint8_t>(PpsState::kError)) return std::nullopt;
  PositionReading reading;
  reading.microseconds_past_hour = packet.microseconds_past_hour;
  reading.pps = static_cast<PpsState>(packet.pps_state);
  reading.gprmc = parse_gprmc({packet.nmea.data(), packet.nmea.size()});
  return reading;
}

bool hour_is_utc(const PositionReading& reading) {
  if (reading.pps != PpsState::kLocked || !reading.gprmc || !reading.gprmc->receiver_valid) {
    return false;
  }
  constexpr std::chrono::nanoseconds kHour = 1h;
  const std::chrono::nanoseconds count = std::chrono::microseconds(reading.microseconds_past_hour);
  // Shifted by the lead, so that the hour's turn between the two needs no case of its own.
  const auto age =
      (count - reading.gprmc->time_of_day % kHour + kMaxSentenceLead + 2 * kHour) % kHour;
  return age <= kMaxSentenceLead + kMaxSentenceAge;
}

}  // namespace sparsight
