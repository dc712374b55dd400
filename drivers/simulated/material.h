#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "drivers/simulated/texture.h"

namespace sparsight::simulated {

inline constexpr int kNoTexture = -1;

// What a surface looks like to the camera and to the LiDAR. Lengths in metres on the surface.
struct Material {
  float albedo = 0.6F;                                  // multiplies the pattern
  int pattern = kNoTexture;                             // anchored at the panel's corner
  Eigen::Vector2f pattern_m = Eigen::Vector2f::Ones();  // size of one repetition
  int stain = kNoTexture;                               // unevenness of metres, beginning anywhere
  float stain_m = 6.0F;
  float stain_gain = 0.0F;
  int detail = kNoTexture;  // unevenness of millimetres to decimetres, beginning anywhere
  float detail_m = 0.7F;
  float detail_gain = 0.0F;
  Eigen::Vector3f tint = Eigen::Vector3f::Ones();  // see tint(); only colour cameras notice
  float emission = 0.0F;                           // light given off; lamps and windows
  std::uint8_t reflectivity = 40;  // calibrated, as the sensor reports it; above 100 reflects back
  float dropout = 0.004F;          // share of firings without return: glass, polished metal
};

struct MaterialLibrary {
  std::vector<Texture> textures;
  std::vector<Material> materials;

  // Index of what was added.
  int add(Texture texture);
  int add(const Material& material);

  // Share of light given back at a place of the surface; `offset` is where the panel's unevenness
  // begins.
  float albedo(const Material& material, const Eigen::Vector2f& at, const Eigen::Vector2f& offset,
               const Footprint& footprint) const;
};

}  // namespace sparsight::simulated
