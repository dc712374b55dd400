#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "hal/lidar.h"

namespace sparsight {

// The message that a payload is, if it has exactly the size of one.
template <typename Packet>
std::optional<LidarMessage> lidar_message(std::span<const std::uint8_t> payload, HostTime arrival) {
  Packet packet;
  if (payload.size() != packet.payload.size()) return std::nullopt;
  packet.arrival = arrival;
  std::copy(payload.begin(), payload.end(), packet.payload.begin());
  return packet;
}

}  // namespace sparsight
