#include "tests/synthetic/scenes/palette.h"

#include <utility>

namespace sparsight::synthetic {
namespace {

MaterialRef make(Material material) {
  return std::make_shared<const Material>(std::move(material));
}

}  // namespace

MaterialRef foliage(Random& random) {
  return make({.base = random.uniform(60.0, 95.0),
               .layers = {Blotches{20.0, {0.45, 0.03, 0.9, random.bits()}},
                          Grain{26.0, {1.5, 0.01, 0.9, random.bits()}}},
               .reflectivity = 0.25,
               .range_scatter_m = 0.35});
}

MaterialRef bark(Random& random) {
  return make({.base = random.uniform(55.0, 90.0),
               .layers = {Patches{16.0, {0.06, 0.5}, 3, random.bits()},
                          Grain{12.0, {0.3, 0.01, 0.7, random.bits()}}},
               .reflectivity = 0.3});
}

MaterialRef facade(Random& random) {
  const double storey = random.uniform(2.8, 3.4);
  const double spacing = random.uniform(1.8, 3.6);
  const Eigen::Vector2d window(spacing * random.uniform(0.35, 0.65), random.uniform(1.2, 1.8));
  const Eigen::Vector2d offset(random.uniform(0.2, 0.8), 0.9);
  const Eigen::Vector2d rim = Eigen::Vector2d::Constant(0.09);
  const std::uint64_t seed = random.bits();
  Material material{.base = random.uniform(105.0, 185.0), .reflectivity = random.uniform(0.3, 0.6)};
  material.layers = {Grain{7.0, {6.0, 0.02, 0.75, random.bits()}},
                     Patches{random.uniform(2.0, 9.0), {0.25, 0.08}, 1, random.bits()},
                     Panels{35.0, 0.0, {spacing, storey}, window + 2.0 * rim, offset - rim, seed},
                     Panels{-95.0, 30.0, {spacing, storey}, window, offset, seed},
                     Lines{-14.0, {0.0, storey}, 0.12},
                     Band{-30.0, 0.0, 0.5}};
  if (random.chance(0.5)) material.layers.push_back(Lines{-10.0, {0.24, 0.08}, 0.012});
  return make(std::move(material));
}

MaterialRef brick(Random& random) {
  return make(
      {.base = random.uniform(85.0, 130.0),
       .layers = {Patches{14.0, {0.25, 0.075}, 1, random.bits()}, Lines{22.0, {0.25, 0.075}, 0.012},
                  Grain{9.0, {3.0, 0.01, 0.75, random.bits()}}},
       .reflectivity = 0.35});
}

MaterialRef car_body(Random& random) {
  const double tone = random.chance(0.4) ? random.uniform(25.0, 60.0) : random.uniform(90.0, 215.0);
  return make(
      {.base = tone,
       .layers = {Grain{5.0, {1.5, 0.1, 0.6, random.bits()}}, Lines{-18.0, {1.1, 0.0}, 0.015},
                  Band{-25.0, -1.0, 0.12}, Band{10.0, 0.4, 0.45}},
       .reflectivity = 0.5});
}

MaterialRef car_glass(Random& random) {
  return make(
      {.base = random.uniform(30.0, 60.0),
       .layers = {Grain{16.0, {0.8, 0.05, 0.6, random.bits()}}, Lines{45.0, {0.9, 0.0}, 0.07}},
       .reflectivity = 0.15});
}

MaterialRef tyre() { return make({.base = 28.0, .reflectivity = 0.1}); }

MaterialRef plate(Random& random) {
  return make({.base = random.uniform(180.0, 230.0),
               .layers = {Patches{60.0, {0.05, 0.08}, 1, random.bits()}},
               .reflectivity = 0.9});
}

MaterialRef metal(Random& random) {
  return make({.base = random.uniform(130.0, 170.0),
               .layers = {Grain{10.0, {2.0, 0.02, 0.7, random.bits()}}, Band{-35.0, 0.12, 0.19},
                          Lines{-12.0, {4.0, 0.0}, 0.05}},
               .reflectivity = 0.7});
}

MaterialRef road(const RoadMarks& marks, double contrast) {
  return make({.base = 82.0,
               .layers = {Grain{contrast, {5.0, 0.01, 0.82, 11}},
                          Patches{0.5 * contrast, {7.0, 2.9}, 2, 12},
                          Blotches{0.4 * contrast, {1.7, 0.05, 0.6, 13}}, marks},
               .reflectivity = 0.25});
}

MaterialRef plaster(Random& random, double contrast) {
  return make({.base = random.uniform(150.0, 190.0),
               .layers = {Grain{contrast, {3.0, 0.01, 0.82, random.bits()}}, Band{-70.0, 0.0, 0.1}},
               .reflectivity = 0.6});
}

MaterialRef door(Random& random) {
  return make({.base = random.uniform(80.0, 130.0),
               .layers = {Patches{5.0, {0.04, 2.0}, 2, random.bits()},
                          Grain{4.0, {0.5, 0.01, 0.7, random.bits()}},
                          Panels{55.0, 10.0, {9.0, 9.0}, {0.16, 0.1}, {0.3, 1.5}, random.bits()},
                          Panels{60.0, 0.0, {9.0, 9.0}, {0.12, 0.04}, {0.75, 1.0}, 1}},
               .reflectivity = 0.4});
}

MaterialRef poster(Random& random) {
  return make({.base = random.uniform(110.0, 190.0),
               .layers = {Patches{45.0, {0.21, 0.16}, 4, random.bits()},
                          Blotches{14.0, {0.15, 0.01, 0.7, random.bits()}}},
               .reflectivity = 0.7});
}

MaterialRef floor_tiles(Random& random, double tile_m, double contrast) {
  return make({.base = random.uniform(105.0, 140.0),
               .layers = {Lines{-4.0 * contrast, {tile_m, tile_m}, 0.008},
                          Patches{contrast, {tile_m, tile_m}, 1, random.bits()},
                          Grain{contrast, {2.0, 0.005, 0.84, random.bits()}}},
               .reflectivity = 0.3});
}

MaterialRef ceiling(Random& random) {
  return make({.base = 170.0,
               .layers = {Lines{-25.0, {0.62, 0.62}, 0.02},
                          Panels{70.0, 0.0, {2.48, 2.48}, {1.2, 0.3}, {0.64, 0.8}, 3},
                          Grain{3.0, {1.0, 0.02, 0.7, random.bits()}}},
               .reflectivity = 0.7});
}

MaterialRef wood(Random& random) {
  return make({.base = random.uniform(90.0, 150.0),
               .layers = {Patches{9.0, {0.9, 0.03}, 2, random.bits()},
                          Grain{9.0, {0.4, 0.005, 0.72, random.bits()}}},
               .reflectivity = 0.4});
}

MaterialRef cardboard(Random& random) {
  return make({.base = random.uniform(110.0, 160.0),
               .layers = {Grain{6.0, {0.7, 0.005, 0.7, random.bits()}},
                          Panels{70.0, 20.0, {0.7, 0.6}, {0.2, 0.14}, {0.1, 0.12}, random.bits()},
                          Lines{-25.0, {0.0, 0.37}, 0.05}},
               .reflectivity = 0.5});
}

MaterialRef plain(double tone, double contrast, std::uint64_t seed) {
  return make({.base = tone, .layers = {Grain{contrast, {1.0, 0.005, 0.8, seed}}}});
}

}  // namespace sparsight::synthetic
