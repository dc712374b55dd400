#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "drivers/simulated/material.h"
#include "drivers/simulated/panel.h"
#include "drivers/simulated/walk.h"

namespace sparsight::simulated {

// Where light comes from besides the surfaces that give it off.
struct Daylight {
  Eigen::Vector3f towards_sun = Eigen::Vector3f(0.4F, -0.5F, 0.75F);
  float sun = 0.0F;  // none: indoors
  float sky = 0.0F;
  float cloud_cover = 0.5F;
  int clouds = kNoTexture;
};

// All that is needed to look at a place and to walk through it. World frame: z up, metres.
struct Scene {
  MaterialLibrary library;
  std::vector<Panel> panels;
  Daylight daylight;
  float bounced_light = 0.5F;     // light that walls throw back on each other
  float light_spacing_m = 0.15F;  // between the places at which light is computed
  float exposure_gain = 150.0F;   // grey levels per unit of light at nominal exposure
  WalkPlan walk;
};

}  // namespace sparsight::simulated
