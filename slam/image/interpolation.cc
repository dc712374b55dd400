#include "slam/image/interpolation.h"

#include <array>

namespace sparsight {

ImageSample sample(const GreyImage& image, float u, float v) {
  const int u0 = static_cast<int>(u);
  const int v0 = static_cast<int>(v);
  const float a = u - static_cast<float>(u0);
  const float b = v - static_cast<float>(v0);
  const auto pixel = [&](int i, int j) { return static_cast<float>(image.at(u0 + i, v0 + j)); };
  const auto along_u = [&](int i, int j) {
    return pixel(i, j) + a * (pixel(i + 1, j) - pixel(i, j));
  };
  // Rows v0 - 1 .. v0 + 2, interpolated at u.
  const std::array<float, 4> row{along_u(0, -1), along_u(0, 0), along_u(0, 1), along_u(0, 2)};
  const auto slope_u = [&](int j) { return 0.5F * (along_u(1, j) - along_u(-1, j)); };
  const auto blend = [&](float upper, float lower) { return upper + b * (lower - upper); };
  return {.value = blend(row[1], row[2]),
          .du = blend(slope_u(0), slope_u(1)),
          .dv = 0.5F * blend(row[2] - row[0], row[3] - row[1])};
}

float sample_value(const GreyImage& image, float u, float v) {
  const int u0 = static_cast<int>(u);
  const int v0 = static_cast<int>(v);
  const float a = u - static_cast<float>(u0);
  const float b = v - static_cast<float>(v0);
  const auto pixel = [&](int i, int j) { return static_cast<float>(image.at(u0 + i, v0 + j)); };
  const float upper = pixel(0, 0) + a * (pixel(1, 0) - pixel(0, 0));
  const float lower = pixel(0, 1) + a * (pixel(1, 1) - pixel(0, 1));
  return upper + b * (lower - upper);
}

}  // namespace sparsight
