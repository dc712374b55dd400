#pragma once

#include <cstdint>

#include "tests/synthetic/scene.h"

namespace sparsight::synthetic {

// 1.2 m per frame past buildings, parked cars and trees on a winding street; HDL-64E.
Scene make_street(std::uint64_t seed);
// 2.8 m per frame from the first: guard rails, lane marks, little else, and cars that keep pace.
Scene make_highway(std::uint64_t seed);
// The car brakes, stands while others cross in front and beside, and drives on.
Scene make_lights(std::uint64_t seed);
// Hand-held, VLP-16: a lap of repeating doors, bare walls, quick turns of the head.
Scene make_corridor(std::uint64_t seed);
// Hand-held, VLP-16: a big room with things standing about.
Scene make_hall(std::uint64_t seed);
// Hand-held RGB-D over a desk.
Scene make_desk(std::uint64_t seed);
// The corridor with a camera whose exposure drifts and jumps.
Scene make_exposure(std::uint64_t seed);

}  // namespace sparsight::synthetic
