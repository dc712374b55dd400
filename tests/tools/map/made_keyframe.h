#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "slam/retired_keyframe.h"

// Keyframes as large and as full of features as real ones, made in no time.
namespace sparsight::testing {

inline GreyImage patchwork(int width, int height, std::uint32_t seed) {
  std::mt19937 random(seed);
  GreyImage image{width, height, std::vector<std::uint8_t>(std::size_t(width) * height, 128)};
  for (int patch = 0; patch < 700; ++patch) {
    const int left = static_cast<int>(random() % width);
    const int top = static_cast<int>(random() % height);
    const int right = std::min<int>(width, left + 4 + static_cast<int>(random() % 40));
    const int bottom = std::min<int>(height, top + 4 + static_cast<int>(random() % 40));
    const auto grey = static_cast<std::uint8_t>(random() % 256);
    for (int v = top; v < bottom; ++v) {
      for (int u = left; u < right; ++u) image.pixels[std::size_t(v) * width + u] = grey;
    }
  }
  return image;
}

inline std::vector<CloudPoint> made_cloud(std::size_t points, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> sideways(-4.0F, 4.0F);
  std::uniform_real_distribution<float> ahead(1.0F, 20.0F);
  std::vector<CloudPoint> cloud(points);
  for (CloudPoint& point : cloud) {
    point.p_camera = {sideways(random), sideways(random), ahead(random)};
    point.intensity = static_cast<float>(random() % 256);
    for (auto& channel : point.rgb) channel = static_cast<std::uint8_t>(random() % 256);
    point.colored = random() % 8 != 0;
  }
  return cloud;
}

// Half a metre after the one before.
inline RetiredKeyframe made_keyframe(std::uint64_t sequence, int width = 800, int height = 600,
                                     std::size_t points = 7000) {
  const auto seed = static_cast<std::uint32_t>(sequence);
  RetiredKeyframe keyframe{.sequence = sequence};
  keyframe.T_world_camera.translation().z() = 0.5 * static_cast<double>(sequence);
  keyframe.successor = {
      .sequence = sequence + 1,
      .T_keyframe_successor = Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.5)),
      .information = 1e4 * Matrix6d::Identity()};
  keyframe.cloud_camera = made_cloud(points, seed);
  keyframe.pyramid = ImagePyramid(patchwork(width, height, seed), 4);
  return keyframe;
}

}  // namespace sparsight::testing
