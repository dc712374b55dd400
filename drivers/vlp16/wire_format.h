#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

// The VLP-16's packets as they lie in memory. VLP-16 User Manual 63-9243 Rev D, p. 55-57 (data) and
// 60 (position); all numbers little-endian. What a field means is said where it is read.
namespace sparsight::wire {

static_assert(std::endian::native == std::endian::little, "the sensor's byte order");

inline constexpr std::uint16_t kBlockFlag = 0xEEFF;  // the bytes FF EE
inline constexpr std::uint16_t kFullTurnCentideg = 36000;

inline constexpr std::uint8_t kStrongest = 0x37;
inline constexpr std::uint8_t kLast = 0x38;
inline constexpr std::uint8_t kDual = 0x39;

inline constexpr std::uint8_t kVlp16 = 0x22;  // and Puck LITE
inline constexpr std::uint8_t kVlp16HiRes = 0x24;

// Packed structs are only ever copied whole: a reference to a misaligned member must not be taken.
#pragma pack(push, 1)
struct Measurement {
  std::uint16_t distance_2mm;
  std::uint8_t reflectivity;
};
struct Block {
  std::uint16_t flag;
  std::uint16_t azimuth_centideg;
  std::array<Measurement, 32> measurements;  // two firing sequences
};
struct DataPacket {
  std::array<Block, 12> blocks;
  std::uint32_t microseconds_past_hour;
  std::uint8_t return_mode;
  std::uint8_t product;
};
struct PositionPacket {
  // Temperatures and calibration in firmware of 2018 and later, nothing before. (Old layouts that
  // put gyroscopes and accelerometers here are those of the HDL-32E.)
  std::array<std::uint8_t, 198> unused;
  std::uint32_t microseconds_past_hour;
  std::uint8_t pps_state;
  std::array<std::uint8_t, 3> thermal;
  std::array<char, 306> nmea;  // the sentence as the sensor received it, then zeros
};
#pragma pack(pop)

static_assert(sizeof(Measurement) == 3);
static_assert(sizeof(Block) == 100);
static_assert(sizeof(DataPacket) == 1206);
static_assert(sizeof(PositionPacket) == 512);

template <typename Packet>
std::array<std::uint8_t, sizeof(Packet)> to_bytes(const Packet& packet) {
  static_assert(std::is_trivially_copyable_v<Packet>);
  std::array<std::uint8_t, sizeof(Packet)> bytes;
  std::memcpy(bytes.data(), &packet, sizeof(Packet));
  return bytes;
}

template <typename Packet>
Packet from_bytes(const std::array<std::uint8_t, sizeof(Packet)>& bytes) {
  static_assert(std::is_trivially_copyable_v<Packet>);
  Packet packet;
  std::memcpy(&packet, bytes.data(), sizeof(Packet));
  return packet;
}

}  // namespace sparsight::wire
