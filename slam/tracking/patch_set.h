#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "slam/geometry/camera_model.h"
#include "slam/image/pyramid.h"
#include "slam/points/selected_point.h"

namespace sparsight {

// The sparse pattern Omega of eq. (4): eight pixels of a 5x5 patch, as DSO spreads them (Engel et
// al. 2018, Sec. 2.2).
struct PatternOffset {
  int u;
  int v;
};
inline constexpr std::array<PatternOffset, 8> kPattern{
    {{0, 0}, {2, 0}, {1, -1}, {0, -2}, {-1, -1}, {-2, 0}, {-1, 1}, {0, 2}}};
inline constexpr std::size_t kPatternSize = kPattern.size();

// The patches of a keyframe at one pyramid level, one entry per pattern pixel, as structure of
// arrays for the vector kernel. Patch k holds the entries [k * kPatternSize, (k + 1) * ...). The
// arrays are padded with entries of weight 0 to a multiple of kBlock.
struct PatchSet {
  static constexpr std::size_t kBlock = 16;

  std::vector<float> x, y, z;    // where the pixel's ray meets the surface; keyframe camera, metres
  std::vector<float> intensity;  // I_m, grey levels
  std::vector<float> weight;     // of the residual, before the robust weight
  std::size_t patches = 0;

  std::size_t entries() const { return x.size(); }
};

// Pattern pixels outside the image at this level get no weight. `camera` is that of the finest
// level.
PatchSet make_patches(const ImagePyramid& pyramid, int level, const CameraModel& camera,
                      const std::vector<SelectedPoint>& points, double gradient_weight_constant);

}  // namespace sparsight
