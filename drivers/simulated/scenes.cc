#include "drivers/simulated/scenes.h"

namespace sparsight::simulated {

Scene make_scene(SimulatedScene scene, std::uint64_t seed) {
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

}  // namespace sparsight::simulated
