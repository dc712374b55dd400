#include "drivers/simulated/texture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace sparsight::simulated {
namespace {

// A surface seen at a grazing angle is sampled this often along its long axis; beyond, it blurs.
constexpr int kMostTaps = 6;

// Piecewise linear between powers of two: 0.09 off at most, which no eye sees in a mip level.
float rough_log2(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const auto exponent = static_cast<float>(static_cast<int>(bits >> 23U) - 127);
  const float mantissa = std::bit_cast<float>((bits & 0x007fffffU) | 0x3f800000U);
  return exponent + mantissa - 1.0F;
}

int floor_of(float x) {
  const int truncated = static_cast<int>(x);
  return truncated - (static_cast<float>(truncated) > x ? 1 : 0);
}

std::vector<float> halved(const std::vector<float>& fine, int width, int height) {
  const int out_width = std::max(1, width / 2);
  const int out_height = std::max(1, height / 2);
  std::vector<float> coarse(static_cast<std::size_t>(out_width) *
                            static_cast<std::size_t>(out_height));
  for (int y = 0; y < out_height; ++y) {
    for (int x = 0; x < out_width; ++x) {
      const int x0 = std::min(2 * x, width - 1);
      const int x1 = std::min(2 * x + 1, width - 1);
      const int y0 = std::min(2 * y, height - 1) * width;
      const int y1 = std::min(2 * y + 1, height - 1) * width;
      coarse[y * out_width + x] =
          0.25F * (fine[y0 + x0] + fine[y0 + x1] + fine[y1 + x0] + fine[y1 + x1]);
    }
  }
  return coarse;
}

}  // namespace

Texture::Texture(int width, int height, const std::vector<float>& values) {
  std::vector<float> level = values;
  while (true) {
    Level stored{width, height, std::vector<std::uint8_t>(level.size())};
    std::ranges::transform(level, stored.texels.begin(), [](float value) {
      return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
    });
    levels_.push_back(std::move(stored));
    if (width == 1 && height == 1) break;
    level = halved(level, width, height);
    width = std::max(1, width / 2);
    height = std::max(1, height / 2);
  }
}

float Texture::bilinear(const Level& level, const Eigen::Vector2f& at) {
  const float x = at.x() * static_cast<float>(level.width) - 0.5F;
  const float y = at.y() * static_cast<float>(level.height) - 0.5F;
  const int x_floor = floor_of(x);
  const int y_floor = floor_of(y);
  const float a = x - static_cast<float>(x_floor);
  const float b = y - static_cast<float>(y_floor);
  // Powers of two: the remainder of a repetition is a mask, for negative numbers too.
  const int x0 = x_floor & (level.width - 1);
  const int x1 = (x_floor + 1) & (level.width - 1);
  const int y0 = (y_floor & (level.height - 1)) * level.width;
  const int y1 = ((y_floor + 1) & (level.height - 1)) * level.width;
  const std::uint8_t* texels = level.texels.data();
  const float top =
      static_cast<float>(texels[y0 + x0]) * (1 - a) + static_cast<float>(texels[y0 + x1]) * a;
  const float low =
      static_cast<float>(texels[y1 + x0]) * (1 - a) + static_cast<float>(texels[y1 + x1]) * a;
  return (top * (1 - b) + low * b) * (1.0F / 255.0F);
}

float Texture::sample(const Eigen::Vector2f& at, const Footprint& footprint) const {
  const Eigen::Vector2f size(static_cast<float>(width()), static_cast<float>(height()));
  const float right = footprint.right.cwiseProduct(size).squaredNorm();
  const float down = footprint.down.cwiseProduct(size).squaredNorm();
  const Eigen::Vector2f& axis = right > down ? footprint.right : footprint.down;
  const float longer = std::sqrt(std::max(right, down));
  const float shorter = std::sqrt(std::min(right, down));
  const int taps =
      std::clamp(static_cast<int>(longer / std::max(shorter, 1.0F) + 0.7F), 1, kMostTaps);
  const float across = std::max(longer / static_cast<float>(taps), 1.0F);
  const float depth = std::min(rough_log2(across), static_cast<float>(levels_.size() - 1));
  const auto level = static_cast<std::size_t>(depth);
  const float share = depth - static_cast<float>(level);
  const bool blend = share > 0.02F && level + 1 < levels_.size();
  float sum = 0.0F;
  for (int tap = 0; tap < taps; ++tap) {
    const float along = (static_cast<float>(tap) + 0.5F) / static_cast<float>(taps) - 0.5F;
    const Eigen::Vector2f place = at + along * axis;
    const float fine = bilinear(levels_[level], place);
    sum += blend ? fine + share * (bilinear(levels_[level + 1], place) - fine) : fine;
  }
  return sum / static_cast<float>(taps);
}

}  // namespace sparsight::simulated
