#include "drivers/simulated/tint.h"

#include <algorithm>
#include <cmath>

namespace sparsight::simulated {

Eigen::Vector3f tint(float hue_deg, float saturation) {
  const Eigen::Vector3f luma(0.299F, 0.587F, 0.114F);  // ITU-R BT.601
  const auto level = [&](float at) {
    return std::clamp(2.0F - std::abs(std::remainder(hue_deg - at, 360.0F)) / 60.0F, 0.0F, 1.0F);
  };
  const Eigen::Vector3f pure(level(0.0F), level(120.0F), level(240.0F));
  const Eigen::Vector3f grey = Eigen::Vector3f::Constant(luma.dot(pure));
  const Eigen::Vector3f mixed =
      (Eigen::Vector3f::Ones() + saturation * (pure - grey)).cwiseMax(0.08F);
  return mixed / luma.dot(mixed);
}

}  // namespace sparsight::simulated
