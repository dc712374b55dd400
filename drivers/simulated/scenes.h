#pragma once

#include "drivers/simulated/scene.h"
#include "drivers/simulated/simulation_options.h"

namespace sparsight::simulated {

Scene make_scene(const SimulationOptions& options);

}  // namespace sparsight::simulated
