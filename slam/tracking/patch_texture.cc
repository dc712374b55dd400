#include "slam/tracking/patch_texture.h"

namespace sparsight {

int textured_patches(const PatchSet& patches) {
  int textured = 0;
  for (std::size_t patch = 0; patch < patches.patches; ++patch) {
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < kPatternSize; ++i) {
      const double grey = patches.intensity[patch * kPatternSize + i];
      sum += grey;
      squares += grey * grey;
    }
    const double mean = sum / kPatternSize;
    if (squares / kPatternSize - mean * mean >= kTextureGrey * kTextureGrey) ++textured;
  }
  return textured;
}

}  // namespace sparsight
