#include "drivers/simulated/texture.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace sparsight::simulated {
namespace {

// A surface seen at a grazing angle is sampled this often along its long axis; beyond, it blurs.
constexpr int kMostTaps = 4;

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

float bilinear(const std::uint8_t* texels, int width, int height, const Eigen::Vector2f& at) {
  const float x = at.x() * static_cast<float>(width) - 0.5F;
  const float y = at.y() * static_cast<float>(height) - 0.5F;
  const int x_floor = floor_of(x);
  const int y_floor = floor_of(y);
  const float a = x - static_cast<float>(x_floor);
  const float b = y - static_cast<float>(y_floor);
  // Powers of two: the remainder of a repetition is a mask, for negative numbers too.
  const int x0 = x_floor & (width - 1);
  const int x1 = (x_floor + 1) & (width - 1);
  const std::uint8_t* low = texels + (y_floor & (height - 1)) * width;
  const std::uint8_t* high = texels + ((y_floor + 1) & (height - 1)) * width;
  const auto left = static_cast<float>(low[x0]);
  const auto left_high = static_cast<float>(high[x0]);
  const float below = left + a * (static_cast<float>(low[x1]) - left);
  const float above = left_high + a * (static_cast<float>(high[x1]) - left_high);
  return (below + b * (above - below)) * (1.0F / 255.0F);
}

struct Lengths {
  float longer;
  float shorter;
  Eigen::Vector2f axis;  // the longer one
};

Lengths in_texels(const Footprint& footprint, int width, int height) {
  const Eigen::Vector2f size(static_cast<float>(width), static_cast<float>(height));
  const float right = footprint.right.cwiseProduct(size).squaredNorm();
  const float down = footprint.down.cwiseProduct(size).squaredNorm();
  return {std::sqrt(std::max(right, down)), std::sqrt(std::min(right, down)),
          right > down ? footprint.right : footprint.down};
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

float Texture::between_levels(const Eigen::Vector2f& at, float depth) const {
  const auto index = static_cast<std::size_t>(depth);
  const float share = depth - static_cast<float>(index);
  const Level& fine = levels_[index];
  const float value = bilinear(fine.texels.data(), fine.width, fine.height, at);
  if (share < 0.02F || index + 1 >= levels_.size()) return value;
  const Level& coarse = levels_[index + 1];
  return value + share * (bilinear(coarse.texels.data(), coarse.width, coarse.height, at) - value);
}

float Texture::sample(const Eigen::Vector2f& at, const Footprint& footprint) const {
  const Lengths lengths = in_texels(footprint, width(), height());
  const int taps =
      std::clamp(static_cast<int>(0.75F * lengths.longer / std::max(lengths.shorter, 1.0F) + 0.75F),
                 1, kMostTaps);
  const float across = std::max(lengths.longer / static_cast<float>(taps), 1.0F);
  const float depth = std::min(rough_log2(across), static_cast<float>(levels_.size() - 1));
  if (taps == 1) return between_levels(at, depth);
  const Eigen::Vector2f step = lengths.axis / static_cast<float>(taps);
  Eigen::Vector2f place = at - (0.5F * static_cast<float>(taps - 1)) * step;
  float sum = 0.0F;
  for (int tap = 0; tap < taps; ++tap, place += step) sum += between_levels(place, depth);
  return sum / static_cast<float>(taps);
}

float Texture::sample_soft(const Eigen::Vector2f& at, const Footprint& footprint) const {
  const Lengths lengths = in_texels(footprint, width(), height());
  const float across = std::max(std::sqrt(lengths.longer * lengths.shorter), 1.0F);
  return between_levels(at, std::min(rough_log2(across), static_cast<float>(levels_.size() - 1)));
}

}  // namespace sparsight::simulated
