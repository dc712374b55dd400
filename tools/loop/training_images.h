#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/simulated/simulation_options.h"
#include "hal/image.h"
#include "hal/result.h"

namespace sparsight {

// Every image file (PNG, JPEG) below a folder, in the order of their paths, as grey.
Result<std::vector<GreyImage>> images_in_folder(const std::string& folder);

// What the simulated rig's camera sees on its way through a scene, without noise of the sensor.
struct RenderingPlan {
  SimulatedScene scene = SimulatedScene::kCorridor;
  double duration_s = 60.0;  // a lap of the corridor
  double rate_hz = 2.0;
  int width = 400;  // of the keyframe images that places are recognised in
  int height = 300;
  double light_detail = 1.0;
  std::uint64_t seed = 1;
};
std::vector<GreyImage> rendered_images(const RenderingPlan& plan);

}  // namespace sparsight
