#include "drivers/simulated/scenes.h"
namespace sparsight::simulated {
Scene make_hall(std::uint64_t seed) { return make_corridor(seed); }
Scene make_street(std::uint64_t seed) { return make_corridor(seed); }
}  // namespace sparsight::simulated
