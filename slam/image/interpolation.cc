#include "slam/image/interpolation.h"

#include <array>

namespace sparsight {
namespace {

// A place among the pixels around it.
struct Place {
  const GreyImage& image;
  int u0, v0;
  float a, b;  // what is left of u and v, below 1

  Place(const GreyImage& in, float u, float v)
      : image(in),
        u0(static_cast<int>(u)),
        v0(static_cast<int>(v)),
        a(u - static_cast<float>(u0)),
        b(v - static_cast<float>(v0)) {}

  float pixel(int i, int j) const { return static_cast<float>(image.at(u0 + i, v0 + j)); }
  float along_u(int i, int j) const { return pixel(i, j) + a * (pixel(i + 1, j) - pixel(i, j)); }
  float blend(float upper, float lower) const { return upper + b * (lower - upper); }
};

}  // namespace

ImageSample sample(const GreyImage& image, float u, float v) {
  const Place at(image, u, v);
  // Rows v0 - 1 .. v0 + 2, interpolated at u.
  const std::array<float, 4> row{at.along_u(0, -1), at.along_u(0, 0), at.along_u(0, 1),
                                 at.along_u(0, 2)};
  const auto slope_u = [&](int j) { return 0.5F * (at.along_u(1, j) - at.along_u(-1, j)); };
  return {.value = at.blend(row[1], row[2]),
          .du = at.blend(slope_u(0), slope_u(1)),
          .dv = 0.5F * at.blend(row[2] - row[0], row[3] - row[1])};
}

float sample_value(const GreyImage& image, float u, float v) {
  const Place at(image, u, v);
  return at.blend(at.along_u(0, 0), at.along_u(0, 1));
}

}  // namespace sparsight
