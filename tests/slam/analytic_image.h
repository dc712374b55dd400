#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "hal/image.h"

namespace sparsight {

// An image whose grey value, and so its gradient, is known everywhere: grey(u, v), rounded.
template <typename Grey>
GreyImage analytic_image(int width, int height, const Grey& grey) {
  GreyImage image{width, height, {}};
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double value = std::clamp(static_cast<double>(grey(u, v)), 0.0, 255.0);
      image.pixels.push_back(static_cast<std::uint8_t>(std::lround(value)));
    }
  }
  return image;
}

}  // namespace sparsight
