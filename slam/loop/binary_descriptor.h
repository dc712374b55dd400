#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace sparsight {

// 256 bits of ORB, bit k of the descriptor's byte b as bit 8 (b % 8) + k of word b / 8.
using BinaryDescriptor = std::array<std::uint64_t, 4>;
inline constexpr std::size_t kDescriptorBytes = 32;

inline int hamming_distance(const BinaryDescriptor& a, const BinaryDescriptor& b) {
  int distance = 0;
  for (std::size_t i = 0; i < a.size(); ++i) distance += std::popcount(a[i] ^ b[i]);
  return distance;
}

inline std::uint8_t descriptor_byte(const BinaryDescriptor& descriptor, std::size_t byte) {
  return static_cast<std::uint8_t>(descriptor[byte / 8] >> (8 * (byte % 8)));
}

inline void set_descriptor_byte(BinaryDescriptor& descriptor, std::size_t byte,
                                std::uint8_t value) {
  const auto shift = 8 * (byte % 8);
  descriptor[byte / 8] &= ~(std::uint64_t{0xFF} << shift);
  descriptor[byte / 8] |= std::uint64_t{value} << shift;
}

}  // namespace sparsight
