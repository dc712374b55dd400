#include "drivers/simulated/canvas.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sparsight::simulated {
namespace {

std::vector<float> white_noise(int size, Random& random) {
  std::vector<float> values(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  for (float& value : values) value = random.uniform_f(-1.0, 1.0);
  return values;
}

// Doubles the size with the weights of a quadratic B-spline, 3/4 and 1/4 along each axis (Chaikin).
std::vector<float> doubled(const std::vector<float>& coarse, int size) {
  const int mask = size - 1;
  std::vector<float> wide(coarse.size() * 2);
  for (int y = 0; y < size; ++y) {
    const float* row = &coarse[static_cast<std::size_t>(y * size)];
    float* out = &wide[static_cast<std::size_t>(2 * y * size)];
    for (int x = 0; x < size; ++x) {
      out[2 * x] = 0.75F * row[x] + 0.25F * row[(x - 1) & mask];
      out[2 * x + 1] = 0.75F * row[x] + 0.25F * row[(x + 1) & mask];
    }
  }
  std::vector<float> fine(coarse.size() * 4);
  const int width = 2 * size;
  for (int y = 0; y < size; ++y) {
    const float* row = &wide[static_cast<std::size_t>(y * width)];
    const float* above = &wide[static_cast<std::size_t>(((y - 1) & mask) * width)];
    const float* below = &wide[static_cast<std::size_t>(((y + 1) & mask) * width)];
    float* out = &fine[static_cast<std::size_t>(2 * y * width)];
    for (int x = 0; x < width; ++x) {
      out[x] = 0.75F * row[x] + 0.25F * above[x];
      out[x + width] = 0.75F * row[x] + 0.25F * below[x];
    }
  }
  return fine;
}

}  // namespace

std::vector<float> cloud_noise(int size, int coarsest, float falloff, std::uint64_t seed) {
  Random random(seed, 0xc10d);
  std::vector<float> sum = white_noise(coarsest, random);
  float amplitude = 1.0F;
  float power = 1.0F;
  for (int at = coarsest; at < size; at *= 2) {
    sum = doubled(sum, at);
    amplitude *= falloff;
    power += amplitude * amplitude;
    for (float& value : sum) value += amplitude * random.uniform_f(-1.0, 1.0);
  }
  // A uniform value's deviation is 0.58, of which smoothing leaves about half.
  const float scale = 1.6F / std::sqrt(power);
  for (float& value : sum) value = std::clamp(scale * value, -1.0F, 1.0F);
  return sum;
}

Canvas::Canvas(int width, int height, float value)
    : width_(width),
      height_(height),
      values_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {}

void Canvas::rectangle(float x0, float y0, float x1, float y1, float value) {
  const auto pixels = [](float share, int size) {
    return std::clamp(static_cast<int>(std::lround(share * static_cast<float>(size))), 0, size);
  };
  for (int y = pixels(y0, height_); y < pixels(y1, height_); ++y) {
    for (int x = pixels(x0, width_); x < pixels(x1, width_); ++x) at(x, y) = value;
  }
}

void Canvas::disc(float x, float y, float radius_of_height, float value) {
  const float radius = radius_of_height * static_cast<float>(height_);
  const float cx = x * static_cast<float>(width_);
  const float cy = y * static_cast<float>(height_);
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const float distance =
          std::hypot(static_cast<float>(u) + 0.5F - cx, static_cast<float>(v) + 0.5F - cy);
      const float share = std::clamp(radius - distance + 0.5F, 0.0F, 1.0F);
      at(u, v) += share * (value - at(u, v));
    }
  }
}

void Canvas::outline(float x0, float y0, float x1, float y1, float thickness, float value) {
  const float across = thickness * static_cast<float>(height_) / static_cast<float>(width_);
  rectangle(x0, y0, x1, y0 + thickness, value);
  rectangle(x0, y1 - thickness, x1, y1, value);
  rectangle(x0, y0, x0 + across, y1, value);
  rectangle(x1 - across, y0, x1, y1, value);
}

void Canvas::print(float x0, float y0, float x1, float y1, int lines, float value, Random& random) {
  const float line = (y1 - y0) / static_cast<float>(lines);
  const float gap = 0.35F * line * static_cast<float>(height_) / static_cast<float>(width_);
  for (int i = 0; i < lines; ++i) {
    const float low = y0 + line * (static_cast<float>(i) + 0.25F);
    const float end = x1 - random.uniform_f(0.0, 0.4) * (i % 4 == 0 ? x1 - x0 : 0.0F);
    for (float x = x0; x < end;) {
      const float word = std::min(gap * random.uniform_f(2.0, 9.0), end - x);
      rectangle(x, low, x + word, low + 0.5F * line, value);
      x += word + gap;
    }
  }
}

void Canvas::photograph(float x0, float y0, float x1, float y1, Random& random) {
  constexpr int kSize = 256;
  const std::vector<float> soft = cloud_noise(kSize, 4, 0.62F, random.bits());
  const std::vector<float> shape = cloud_noise(kSize, 2, 0.5F, random.bits());
  const float level = random.uniform_f(0.35, 0.6);
  const int left = static_cast<int>(x0 * static_cast<float>(width_));
  const int low = static_cast<int>(y0 * static_cast<float>(height_));
  for (int y = low; y < static_cast<int>(y1 * static_cast<float>(height_)); ++y) {
    for (int x = left; x < static_cast<int>(x1 * static_cast<float>(width_)); ++x) {
      const auto i = static_cast<std::size_t>((y & (kSize - 1)) * kSize + (x & (kSize - 1)));
      const float hard = shape[i] > 0.0F ? 0.22F : (shape[i] > -0.35F ? 0.0F : -0.2F);
      at(x, y) = std::clamp(level + 0.3F * soft[i] + hard, 0.03F, 0.95F);
    }
  }
}

void Canvas::weather(int coarsest, float falloff, float amplitude, std::uint64_t seed) {
  const int size = std::max(width_, height_);
  const std::vector<float> noise = cloud_noise(size, coarsest, falloff, seed);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      at(x, y) *= 1.0F + amplitude * noise[static_cast<std::size_t>(y * size + x)];
    }
  }
}

}  // namespace sparsight::simulated
