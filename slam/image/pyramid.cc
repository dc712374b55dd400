#include "slam/image/pyramid.h"

#include <algorithm>
#include <utility>

namespace sparsight {
namespace {

constexpr int kSmallestSide = 16;

GreyImage halved(const GreyImage& fine) {
  GreyImage coarse;
  coarse.width = fine.width / 2;
  coarse.height = fine.height / 2;
  coarse.pixels.resize(static_cast<std::size_t>(coarse.width) *
                       static_cast<std::size_t>(coarse.height));
  for (int v = 0; v < coarse.height; ++v) {
    const std::uint8_t* upper = fine.pixels.data() + std::ptrdiff_t{2} * v * fine.width;
    const std::uint8_t* lower = upper + fine.width;
    std::uint8_t* out = coarse.pixels.data() + std::ptrdiff_t{v} * coarse.width;
    for (int u = 0; u < coarse.width; ++u) {
      const int sum = upper[2 * u] + upper[2 * u + 1] + lower[2 * u] + lower[2 * u + 1];
      out[u] = static_cast<std::uint8_t>((sum + 2) / 4);
    }
  }
  return coarse;
}

}  // namespace

ImagePyramid::ImagePyramid(GreyImage image, int levels) {
  levels_.reserve(static_cast<std::size_t>(std::max(levels, 1)));
  levels_.push_back(std::move(image));
  while (static_cast<int>(levels_.size()) < levels &&
         std::min(levels_.back().width, levels_.back().height) >= 2 * kSmallestSide) {
    levels_.push_back(halved(levels_.back()));
  }
}

}  // namespace sparsight
