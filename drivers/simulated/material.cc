#include "drivers/simulated/material.h"

#include <utility>

namespace sparsight::simulated {
namespace {

float unevenness(const Texture& texture, float gain, float repeat_m, const Eigen::Vector2f& at,
                 const Footprint& footprint) {
  const float scale = 1.0F / repeat_m;
  const Footprint scaled{footprint.right * scale, footprint.down * scale};
  return 1.0F + gain * (2.0F * texture.sample(at * scale, scaled) - 1.0F);
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
    value *= unevenness(textures[material.stain], material.stain_gain, material.stain_m,
                        at + offset, footprint);
  }
  if (material.detail != kNoTexture) {
    value *= unevenness(textures[material.detail], material.detail_gain, material.detail_m,
                        at + offset, footprint);
  }
  return value;
}

}  // namespace sparsight::simulated
