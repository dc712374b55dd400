#include "drivers/simulated/material.h"

#include <utility>

namespace sparsight::simulated {
namespace {

Footprint operator*(float scale, const Footprint& footprint) {
  return {scale * footprint.right, scale * footprint.down};
}

}  // namespace

int MaterialLibrary::add(Texture texture) {
  textures.push_back(std::move(texture));
  return static_cast<int>(textures.size()) - 1;
}

int MaterialLibrary::add(const Material& material) {
  materials.push_back(material);
  return static_cast<int>(materials.size()) - 1;
}

float MaterialLibrary::albedo(const Material& material, const Eigen::Vector2f& at,
                              const Eigen::Vector2f& offset, const Footprint& footprint) const {
  float value = material.albedo;
  if (material.pattern != kNoTexture) {
    const Eigen::Vector2f scale = material.pattern_m.cwiseInverse();
    value *= textures[material.pattern].sample(
        at.cwiseProduct(scale),
        {footprint.right.cwiseProduct(scale), footprint.down.cwiseProduct(scale)});
  }
  if (material.stain != kNoTexture) {
    const float scale = 1.0F / material.stain_m;
    const float noise =
        textures[material.stain].sample_soft(scale * (at + offset), scale * footprint);
    value *= 1.0F + material.stain_gain * (2.0F * noise - 1.0F);
  }
  if (material.detail != kNoTexture) {
    const float scale = 1.0F / material.detail_m;
    const float noise = textures[material.detail].sample(scale * (at + offset), scale * footprint);
    value *= 1.0F + material.detail_gain * (2.0F * noise - 1.0F);
  }
  return value;
}

}  // namespace sparsight::simulated
