#pragma once

#include <vector>

#include "hal/image.h"

namespace sparsight {

// The image and its halvings by 2x2 means (Sec. III, "multiscale image pyramid"). 8 bits per level:
// tracking reads four neighbouring pixels with one 32-bit load, and a level fits the cache.
class ImagePyramid {
 public:
  ImagePyramid() = default;
  // levels counts the full image. Levels that would fall under 16 pixels are not made.
  ImagePyramid(GreyImage image, int levels);

  int levels() const { return static_cast<int>(levels_.size()); }
  const GreyImage& level(int index) const { return levels_[static_cast<std::size_t>(index)]; }
  bool empty() const { return levels_.empty(); }

 private:
  std::vector<GreyImage> levels_;
};

}  // namespace sparsight
