#pragma once

#include <cstdint>
#include <vector>

#include "drivers/simulated/random.h"
#include "drivers/simulated/texture.h"

namespace sparsight::simulated {

// Noise that repeats: octaves from `coarsest` cells across, each `falloff` times the last, about
// zero and mostly within [-1, 1]. `size` is a power of two.
std::vector<float> cloud_noise(int size, int coarsest, float falloff, std::uint64_t seed);

// What a texture is painted on. Shares of the width and height, (0, 0) the lower left corner.
class Canvas {
 public:
  Canvas(int width, int height, float value);

  void rectangle(float x0, float y0, float x1, float y1, float value);
  void disc(float x, float y, float radius_of_height, float value);
  // Frame of lines just inside the rectangle.
  void outline(float x0, float y0, float x1, float y1, float thickness, float value);
  // Lines of words of random length, as print looks from afar.
  void print(float x0, float y0, float x1, float y1, int lines, float value, Random& random);
  // A picture of soft and hard shapes, as a photograph looks from afar.
  void photograph(float x0, float y0, float x1, float y1, Random& random);
  // Multiplies by 1 + amplitude * noise.
  void weather(int coarsest, float falloff, float amplitude, std::uint64_t seed);

  float& at(int x, int y) { return values_[static_cast<std::size_t>(y * width_ + x)]; }
  int width() const { return width_; }
  int height() const { return height_; }
  Texture texture() const { return {width_, height_, values_}; }

 private:
  int width_;
  int height_;
  std::vector<float> values_;
};

}  // namespace sparsight::simulated
