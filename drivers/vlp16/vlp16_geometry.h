#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace sparsight {

// VLP-16 User Manual 63-9243 Rev D, p. 49-50 and 54, table 9-1.

inline constexpr std::size_t kVlp16Lasers = 16;
inline constexpr std::size_t kVlp16BlocksPerPacket = 12;
inline constexpr std::size_t kVlp16SequencesPerBlock = 2;
inline constexpr std::size_t kVlp16SequencesPerPacket =
    kVlp16BlocksPerPacket * kVlp16SequencesPerBlock;

// All sixteen lasers fire one after the other, then the sensor recharges.
inline constexpr std::chrono::nanoseconds kVlp16FiringInterval{2304};
inline constexpr std::chrono::nanoseconds kVlp16SequenceInterval{55296};
// From the first firing of a packet to that of the next one. A dual packet tells everything twice.
inline constexpr std::chrono::nanoseconds kVlp16PacketInterval = 24 * kVlp16SequenceInterval;
inline constexpr std::chrono::nanoseconds kVlp16DualPacketInterval = 12 * kVlp16SequenceInterval;

inline constexpr double kVlp16DistanceUnitM = 0.002;

struct LaserPlacement {
  double elevation_deg = 0.0;
  double vertical_offset_mm = 0.0;  // of the beam's origin: added to z, to nothing else
  std::uint16_t ring = 0;           // by elevation, 0 the lowest
};

// In the order of firing, which is also the order within a packet.
using LaserTable = std::array<LaserPlacement, kVlp16Lasers>;

inline constexpr LaserTable kVlp16LaserTable{{
    {-15.0, 11.2, 0},
    {1.0, -0.7, 8},
    {-13.0, 9.7, 1},
    {3.0, -2.2, 9},
    {-11.0, 8.1, 2},
    {5.0, -3.7, 10},
    {-9.0, 6.6, 3},
    {7.0, -5.1, 11},
    {-7.0, 5.1, 4},
    {9.0, -6.6, 12},
    {-5.0, 3.7, 5},
    {11.0, -8.1, 13},
    {-3.0, 2.2, 6},
    {13.0, -9.7, 14},
    {-1.0, 0.7, 7},
    {15.0, -11.2, 15},
}};

// The Hi-Res packs the same optics into 20 degrees. Its offsets follow from what the table above
// obeys: -41.91 mm times the tangent of the elevation.
inline constexpr LaserTable kVlp16HiResLaserTable{{
    {-10.0, 7.4, 0},
    {2.0 / 3.0, -0.5, 8},
    {-26.0 / 3.0, 6.4, 1},
    {2.0, -1.5, 9},
    {-22.0 / 3.0, 5.4, 2},
    {10.0 / 3.0, -2.4, 10},
    {-6.0, 4.4, 3},
    {14.0 / 3.0, -3.4, 11},
    {-14.0 / 3.0, 3.4, 4},
    {6.0, -4.4, 12},
    {-10.0 / 3.0, 2.4, 5},
    {22.0 / 3.0, -5.4, 13},
    {-2.0, 1.5, 6},
    {26.0 / 3.0, -6.4, 14},
    {-2.0 / 3.0, 0.5, 7},
    {10.0, -7.4, 15},
}};

// When laser `laser` of sequence `sequence` fires, counted from the packet's first firing.
constexpr std::chrono::nanoseconds firing_offset(std::size_t sequence, std::size_t laser) {
  return static_cast<std::int64_t>(sequence) * kVlp16SequenceInterval +
         static_cast<std::int64_t>(laser) * kVlp16FiringInterval;
}

}  // namespace sparsight
