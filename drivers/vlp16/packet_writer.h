#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "drivers/vlp16/vlp16_geometry.h"
#include "hal/lidar.h"
#include "hal/rig_config.h"

namespace sparsight {

// What all lasers measured in one firing sequence, in the order in which they fire.
struct FiringSequence {
  std::uint16_t azimuth_centideg = 0;                      // of the first firing; 0..35999
  std::array<std::uint16_t, kVlp16Lasers> distance_2mm{};  // 0: no return
  std::array<std::uint8_t, kVlp16Lasers> reflectivity{};
};

using DataPayload = std::array<std::uint8_t, 1206>;
using PositionPayload = std::array<std::uint8_t, 512>;

// A VLP-16 data packet as the sensor sends it: two sequences a block, the block's azimuth that of
// the first of them. `microseconds_past_hour` is the time of the packet's first firing.
// kDual: sequences 4n and 4n + 1 hold the last returns of two firing sequences, 4n + 2 and 4n + 3
// the strongest of the same two (or the second strongest, where the strongest is the last); the
// packet then spans twelve sequences of time.
DataPayload write_data_packet(std::span<const FiringSequence, kVlp16SequencesPerPacket> sequences,
                              std::uint32_t microseconds_past_hour, ReturnMode mode);

// A position packet. `gprmc` is the whole sentence, "$GPRMC,...*hh" with or without its line end;
// what does not fit into the packet is left out.
PositionPayload write_position_packet(std::uint32_t microseconds_past_hour, PpsState pps,
                                      std::string_view gprmc);

}  // namespace sparsight
