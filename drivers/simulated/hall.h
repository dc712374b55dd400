#pragma once

#include <cstdint>

#include "drivers/simulated/scene.h"

namespace sparsight::simulated {

// One large room with columns, shelves and crates.
Scene make_hall(std::uint64_t seed);

}  // namespace sparsight::simulated
