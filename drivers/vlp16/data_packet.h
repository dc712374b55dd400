#pragma once

#include <array>
#include <cstdint>
#include <tl/expected.hpp>

#include "drivers/vlp16/vlp16_geometry.h"
#include "hal/lidar.h"
#include "hal/rig_config.h"

namespace sparsight {

// Why bytes are not a data packet of this sensor.
enum class PacketFault : std::uint8_t {
  kProduct,     // another Velodyne, or firmware before 3.0.29 which does not say
  kReturnMode,  // none of the three
  kBlockFlag,   // a block without its flag
  kAzimuth,     // beyond a full turn
  kPair,        // the two blocks of a dual pair disagree on where they looked
};

const char* to_string(PacketFault fault);

enum class LidarModel : std::uint8_t { kVlp16, kVlp16HiRes };

struct Echo {
  std::uint16_t distance_2mm = 0;  // 0: none
  std::uint8_t reflectivity = 0;
};

// One firing of all lasers, in the order of firing.
struct SequenceReading {
  double azimuth_deg = 0.0;          // of the first firing, [0, 360)
  double turn_per_firing_deg = 0.0;  // how far the head turns from one firing to the next
  std::array<Echo, kVlp16Lasers> echoes;
  // What a dual packet tells beyond `echoes` (the last returns): the strongest, or the second
  // strongest where the last is the strongest. Nothing where both blocks tell the same return.
  std::array<Echo, kVlp16Lasers> second_echoes;
};

struct DataPacket {
  std::uint32_t microseconds_past_hour = 0;  // of the first firing
  ReturnMode mode = ReturnMode::kStrongest;
  LidarModel model = LidarModel::kVlp16;
  std::size_t sequence_count = 0;  // 24; 12 in a dual packet
  double turned_deg = 0.0;         // from its first firing to where the next packet begins
  std::array<SequenceReading, kVlp16SequencesPerPacket> sequences;
};

// Manual p. 55-57 and 66. Writes into `packet`, which a refusal leaves unspecified; does not
// allocate.
tl::expected<void, PacketFault> read_data_packet(const std::array<std::uint8_t, 1206>& payload,
                                                 DataPacket& packet);

}  // namespace sparsight
