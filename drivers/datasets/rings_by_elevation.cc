#include "drivers/datasets/rings_by_elevation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sparsight {
namespace {

constexpr float kBinDegrees = 0.1F;
constexpr std::size_t kBins = 1800;
// A bin with less than this share of a full one's returns is the blur between two lasers.
constexpr double kEmptyShare = 0.02;
// Lasers closer to each other than their blur make one wide band; it is cut into strips as high as
// the HDL-64E's lasers are apart (its manual: 1/3 to 1/2 degree).
constexpr std::size_t kWidestLaserBins = 10;
constexpr std::size_t kStripBins = 4;

std::size_t bin_of(float elevation) {
  const float from_top = (90.0F - elevation) / kBinDegrees;
  return std::min(static_cast<std::size_t>(std::max(from_top, 0.0F)), kBins - 1);
}

std::array<std::size_t, kBins> histogram(const std::vector<float>& elevation) {
  std::array<std::size_t, kBins> counts{};
  for (const float e : elevation) ++counts[bin_of(e)];
  return counts;
}

}  // namespace

std::vector<std::uint16_t> rings_by_elevation(const ScanAngles& angles) {
  const std::array<std::size_t, kBins> counts = histogram(angles.elevation);
  const double full = static_cast<double>(*std::max_element(counts.begin(), counts.end()));
  std::array<std::uint16_t, kBins> ring_of_bin{};
  std::uint16_t next_ring = 0;
  for (std::size_t begin = 0; begin < kBins;) {
    std::size_t end = begin;
    while (end<kBins&& static_cast<double>(counts[end])> kEmptyShare * full) ++end;
    if (end == begin) {
      // Stray returns join the laser above them.
      ring_of_bin[begin++] = next_ring > 0 ? static_cast<std::uint16_t>(next_ring - 1) : 0;
      continue;
    }
    const std::size_t width = end - begin;
    const std::size_t strips = width > kWidestLaserBins ? (width + kStripBins - 1) / kStripBins : 1;
    for (std::size_t i = begin; i < end; ++i) {
      ring_of_bin[i] = static_cast<std::uint16_t>(next_ring + (i - begin) * strips / width);
    }
    next_ring = static_cast<std::uint16_t>(next_ring + strips);
    begin = end;
  }
  std::vector<std::uint16_t> ring;
  ring.reserve(angles.elevation.size());
  for (const float e : angles.elevation) ring.push_back(ring_of_bin[bin_of(e)]);
  return ring;
}

}  // namespace sparsight
