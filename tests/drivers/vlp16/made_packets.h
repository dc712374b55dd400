#pragma once

#include <array>
#include <cstdint>

#include "drivers/vlp16/packet_writer.h"

namespace sparsight::testing {

// What a head sees that turns evenly and whose every laser meets something 10 m away.
struct MadePacket {
  int first_azimuth_centideg = 0;
  int block_gap_centideg = 40;  // from block to block, or pair to pair: 40 are 603 rpm
  std::uint32_t microseconds_past_hour = 0;
  ReturnMode mode = ReturnMode::kStrongest;
  std::uint16_t distance_2mm = 5000;
  std::uint16_t second_distance_2mm = 5000;  // of a dual packet's odd blocks
};

inline DataPayload payload_of(const MadePacket& made) {
  std::array<FiringSequence, kVlp16SequencesPerPacket> sequences;
  for (std::size_t s = 0; s < sequences.size(); ++s) {
    const std::size_t block = s / 2;
    const bool dual = made.mode == ReturnMode::kDual;
    const auto gaps = static_cast<int>(dual ? block / 2 : block);
    const int azimuth = made.first_azimuth_centideg + gaps * made.block_gap_centideg;
    sequences[s].azimuth_centideg = static_cast<std::uint16_t>((azimuth + 36000) % 36000);
    sequences[s].distance_2mm.fill(dual && block % 2 == 1 ? made.second_distance_2mm
                                                          : made.distance_2mm);
    sequences[s].reflectivity.fill(static_cast<std::uint8_t>(10 + block % 2));
  }
  return write_data_packet(sequences, made.microseconds_past_hour, made.mode);
}

inline LidarPacket packet_of(const MadePacket& made, HostTime arrival = {}) {
  return {arrival, payload_of(made)};
}

}  // namespace sparsight::testing
