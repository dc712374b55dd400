#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace sparsight::simulated {

// How a position on a surface moves from one pixel to the next to the right and downwards.
struct Footprint {
  Eigen::Vector2f right = Eigen::Vector2f::Zero();
  Eigen::Vector2f down = Eigen::Vector2f::Zero();
};

// A grey picture that repeats in both directions, [0, 1], with the averages that keep it from
// aliasing at every distance. Thread-safe.
class Texture {
 public:
  Texture() = default;
  // Row after row; width and height are powers of two.
  Texture(int width, int height, const std::vector<float>& values);

  int width() const { return levels_.front().width; }
  int height() const { return levels_.front().height; }

  // Averaged over the footprint; (1, 1) is one repetition.
  float sample(const Eigen::Vector2f& at, const Footprint& footprint) const;
  // The same from one place of the right coarseness: softer where the footprint is long, which is
  // no matter for what is smooth anyway, and some times faster.
  float sample_soft(const Eigen::Vector2f& at, const Footprint& footprint) const;

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> texels;
  };
  float between_levels(const Eigen::Vector2f& at, float depth) const;

  std::vector<Level> levels_;
};

}  // namespace sparsight::simulated
