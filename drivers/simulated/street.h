#pragma once

#include <cstdint>

#include "drivers/simulated/scene.h"

namespace sparsight::simulated {

// Outdoors: a street with facades, parked cars, trees; open sky.
Scene make_street(std::uint64_t seed);

}  // namespace sparsight::simulated
