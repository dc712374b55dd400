#include "drivers/vlp16/packet_writer.h"

#include <algorithm>

#include "drivers/vlp16/wire_format.h"

namespace sparsight {
namespace {

std::uint8_t mode_byte(ReturnMode mode) {
  switch (mode) {
    case ReturnMode::kStrongest:
      return wire::kStrongest;
    case ReturnMode::kLast:
      return wire::kLast;
    case ReturnMode::kDual:
      break;
  }
  return wire::kDual;
}

}  // namespace

DataPayload write_data_packet(std::span<const FiringSequence, kVlp16SequencesPerPacket> sequences,
                              std::uint32_t microseconds_past_hour, ReturnMode mode) {
  wire::DataPacket packet{};
  for (std::size_t s = 0; s < sequences.size(); ++s) {
    const FiringSequence& sequence = sequences[s];
    wire::Block& block = packet.blocks[s / kVlp16SequencesPerBlock];
    const std::size_t first = (s % kVlp16SequencesPerBlock) * kVlp16Lasers;
    if (first == 0) {
      block.flag = wire::kBlockFlag;
      block.azimuth_centideg = sequence.azimuth_centideg;
    }
    for (std::size_t k = 0; k < kVlp16Lasers; ++k) {
      block.measurements[first + k] = {sequence.distance_2mm[k], sequence.reflectivity[k]};
    }
  }
  packet.microseconds_past_hour = microseconds_past_hour;
  packet.return_mode = mode_byte(mode);
  packet.product = wire::kVlp16;
  return wire::to_bytes(packet);
}

PositionPayload write_position_packet(std::uint32_t microseconds_past_hour, PpsState pps,
                                      std::string_view gprmc) {
  wire::PositionPacket packet{};
  packet.microseconds_past_hour = microseconds_past_hour;
  packet.pps_state = static_cast<std::uint8_t>(pps);
  // The sensor pads with zeros; one at least ends the sentence.
  const std::size_t length = std::min(gprmc.size(), packet.nmea.size() - 1);
  std::copy_n(gprmc.begin(), length, packet.nmea.begin());
  return wire::to_bytes(packet);
}

}  // namespace sparsight
