#include "slam/image/pyramid.h"

#include <algorithm>
#include <utility>

#include "slam/image/halving.h"

namespace sparsight {
namespace {

constexpr int kSmallestSide = 16;

void halve(const GreyImage& fine, GreyImage& coarse) {
  coarse.width = fine.width / 2;
  coarse.height = fine.height / 2;
  coarse.pixels.resize(static_cast<std::size_t>(coarse.width) *
                       static_cast<std::size_t>(coarse.height));
  for (int v = 0; v < coarse.height; ++v) {
    const std::uint8_t* upper = fine.pixels.data() + std::ptrdiff_t{2} * v * fine.width;
    const std::uint8_t* lower = upper + fine.width;
    std::uint8_t* out = coarse.pixels.data() + std::ptrdiff_t{v} * coarse.width;
    halve_rows(upper, lower, coarse.width, out);
  }
}

}  // namespace

ImagePyramid::ImagePyramid(GreyImage image, int levels) {
  levels_.resize(static_cast<std::size_t>(std::max(levels, 1)));
  levels_.front() = std::move(image);
  halve_down(levels);
}

void ImagePyramid::assign(const GreyImage& image, int levels) {
  levels_.resize(static_cast<std::size_t>(std::max(levels, 1)));
  levels_.front() = image;
  halve_down(levels);
}

void ImagePyramid::halve_down(int levels) {
  count_ = 1;
  for (; count_ < levels; ++count_) {
    const GreyImage& fine = levels_[static_cast<std::size_t>(count_ - 1)];
    if (std::min(fine.width, fine.height) < 2 * kSmallestSide) return;
    halve(fine, levels_[static_cast<std::size_t>(count_)]);
  }
}

}  // namespace sparsight
