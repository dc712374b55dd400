#pragma once

#include <cstdint>

#include "drivers/simulated/scene.h"

namespace sparsight::simulated {

// A closed loop of corridors of about 60 m: repeated doors, posters, niches, lamps.
Scene make_corridor(std::uint64_t seed);

}  // namespace sparsight::simulated
