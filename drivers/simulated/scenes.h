#pragma once

#include <cstdint>

#include "drivers/simulated/scene.h"
#include "drivers/simulated/simulation_options.h"

namespace sparsight::simulated {

// A closed loop of corridors of about 60 m: repeated doors, posters, niches, lamps.
Scene make_corridor(std::uint64_t seed);
// One large room with columns, shelves and crates.
Scene make_hall(std::uint64_t seed);
// Outdoors: a street with facades, parked cars, trees; open sky.
Scene make_street(std::uint64_t seed);

Scene make_scene(const SimulationOptions& options);

}  // namespace sparsight::simulated
