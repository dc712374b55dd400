#include "drivers/simulated/scenes.h"

#include "drivers/simulated/corridor.h"
#include "drivers/simulated/hall.h"
#include "drivers/simulated/street.h"

namespace sparsight::simulated {
namespace {

Scene by_name(SimulatedScene scene, std::uint64_t seed) {
  switch (scene) {
    case SimulatedScene::kCorridor:
      return make_corridor(seed);
    case SimulatedScene::kHall:
      return make_hall(seed);
    case SimulatedScene::kStreet:
      return make_street(seed);
  }
  return {};
}

}  // namespace

Scene make_scene(const SimulationOptions& options) {
  Scene scene = by_name(options.scene, options.seed);
  scene.light_spacing_m /= static_cast<float>(options.light_detail);
  return scene;
}

}  // namespace sparsight::simulated
