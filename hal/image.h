#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sparsight {

// 8-bit grey image, row after row without padding. Pixel (0, 0) is the centre of the top-left
// pixel; u points right, v points down.
struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> pixels;  // width * height

  bool empty() const { return pixels.empty(); }
  std::uint8_t at(int u, int v) const {
    return pixels[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(u)];
  }
};

// 8-bit red, green, blue, interleaved; same layout as GreyImage.
struct ColorImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // 3 * width * height

  bool empty() const { return rgb.empty(); }
};

}  // namespace sparsight
