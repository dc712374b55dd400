#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "drivers/vlp16/gprmc.h"
#include "hal/lidar.h"

namespace sparsight {

// What a position packet says (manual 63-9243 Rev D, p. 60).
struct PositionReading {
  std::uint32_t microseconds_past_hour = 0;  // when it was put together
  PpsState pps = PpsState::kAbsent;
  std::optional<Gprmc> gprmc;  // the sentence the sensor received last, if it is whole
};

// Nothing if the PPS state is none of the four: then it is no position packet.
std::optional<PositionReading> read_position_packet(const std::array<std::uint8_t, 512>& payload);

// The sensor counts its hour from UTC's. PPS lock and a valid sentence are not proof: a sensor that
// ignored the sentence is off by minutes and says "locked" all the same, so that its count must
// also agree with what the sentence says.
bool hour_is_utc(const PositionReading& reading);

}  // namespace sparsight
