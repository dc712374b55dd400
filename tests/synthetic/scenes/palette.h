#pragma once

#include "tests/synthetic/material.h"
#include "tests/synthetic/random.h"

namespace sparsight::synthetic {

// The materials scenes are made of; each call gives a new piece, unlike the last.

MaterialRef foliage(Random& random);
MaterialRef bark(Random& random);
MaterialRef facade(Random& random);  // plaster or brick with windows, storeys of 3 m
MaterialRef brick(Random& random);
MaterialRef car_body(Random& random);
MaterialRef car_glass(Random& random);
MaterialRef tyre();
MaterialRef plate(Random& random);  // small, bright, printed
MaterialRef metal(Random& random);
MaterialRef road(const RoadMarks& marks, double contrast);

MaterialRef plaster(Random& random, double contrast);  // a wall with skirting board
MaterialRef door(Random& random);
MaterialRef poster(Random& random);
MaterialRef floor_tiles(Random& random, double tile_m, double contrast);
MaterialRef ceiling(Random& random);
MaterialRef wood(Random& random);
MaterialRef cardboard(Random& random);
MaterialRef plain(double tone, double contrast, std::uint64_t seed);

}  // namespace sparsight::synthetic
