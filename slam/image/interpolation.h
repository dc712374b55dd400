#pragma once

#include "hal/image.h"

namespace sparsight {

// Grey value and central-difference gradient, both interpolated bilinearly. Grey levels, per pixel.
struct ImageSample {
  float value = 0.0F;
  float du = 0.0F;
  float dv = 0.0F;
};

// The 4x4 neighbourhood that a sample reads must lie in the image: 1 <= u < width - 2 and
// 1 <= v < height - 2.
inline bool can_sample(int width, int height, float u, float v) {
  return u >= 1.0F && v >= 1.0F && u < static_cast<float>(width - 2) &&
         v < static_cast<float>(height - 2);
}

// Precondition: can_sample(). The scalar reference of what the vector kernel computes.
ImageSample sample(const GreyImage& image, float u, float v);
// Its value alone, of a quarter of the pixels.
float sample_value(const GreyImage& image, float u, float v);

}  // namespace sparsight
