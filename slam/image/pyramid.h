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

  // The same of another image. Keeps its memory: real-time-safe once it has seen an image of that
  // size.
  void assign(const GreyImage& image, int levels);
  void clear() { count_ = 0; }

  int levels() const { return count_; }
  const GreyImage& level(int index) const { return levels_[static_cast<std::size_t>(index)]; }
  bool empty() const { return count_ == 0; }

 private:
  void halve_down(int levels);

  std::vector<GreyImage> levels_;  // the first count_ of them are the pyramid
  int count_ = 0;
};

}  // namespace sparsight
