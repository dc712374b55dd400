#include <cmath>

#include "tests/synthetic/scenes/builder.h"
#include "tests/synthetic/scenes/motions.h"
#include "tests/synthetic/scenes/palette.h"
#include "tests/synthetic/scenes/rigs.h"
#include "tests/synthetic/scenes/scenes.h"

namespace sparsight::synthetic {
namespace {

constexpr double kHalfLength = 17.0;
constexpr double kHalfBreadth = 12.0;
constexpr double kHallHeight = 7.5;

void add_walls(Builder& builder, Random& random) {
  for (const double side : {-1.0, 1.0}) {
    builder.box({0.0, side * kHalfBreadth, 0.0}, {2 * kHalfLength, 0.4, kHallHeight},
                facade(random));
    builder.box({side * kHalfLength, 0.0, 0.0}, {0.4, 2 * kHalfBreadth, kHallHeight},
                side > 0 ? brick(random) : plaster(random, 5.0));
    for (double x = -14.0; x < 15.0; x += 7.0) {
      builder.box({x, side * 8.5, 0.0}, {0.5, 0.5, kHallHeight}, plaster(random, 6.0));
    }
  }
  builder.box({0.0, 0.0, kHallHeight}, {2 * kHalfLength, 2 * kHalfBreadth, 0.2}, ceiling(random));
}

void add_goods(Builder& builder, Random& random) {
  for (int i = 0; i < 60; ++i) {
    const double angle = random.uniform(0.0, 2.0 * M_PI);
    // Along the walls or heaped in the middle; the walk between them stays free.
    const double reach = random.chance(0.3) ? random.uniform(0.0, 0.3) : random.uniform(0.72, 0.95);
    const Eigen::Vector3d foot(reach * kHalfLength * std::cos(angle),
                               reach * kHalfBreadth * std::sin(angle), 0.0);
    const double size = random.uniform(0.4, 1.5);
    builder.box(foot, {size, size * random.uniform(0.6, 1.4), size * random.uniform(0.5, 1.6)},
                random.chance(0.6) ? cardboard(random) : wood(random), random.uniform(0.0, 3.0));
  }
  for (int i = 0; i < 8; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    builder.box({-12.0 + 3.0 * i, side * (kHalfBreadth - 0.25), 1.5}, {2.0, 0.1, 1.4},
                poster(random));
  }
}

}  // namespace

Scene make_hall(std::uint64_t seed) {
  Random random(seed ^ 0x4a11U);
  Builder builder;
  add_walls(builder, random);
  add_goods(builder, random);
  Scene scene;
  scene.rig = hand_held_rig();
  scene.sensor = vlp16();
  scene.world.ground = floor_tiles(random, 1.2, 7.0);
  scene.world.still = builder.finish();
  scene.world.light = {Eigen::Vector3d(0.3, 0.5, 0.8).normalized(), 0.75, 0.4, false};
  scene.imager.noise_grey = 1.5;
  scene.imager.vignetting = 0.15;
  // Somebody walks about in the middle.
  Builder person;
  person.box({0.0, 0.0, 0.0}, {0.3, 0.4, 0.85}, plain(60.0, 10.0, 21));
  person.box({0.0, 0.0, 0.85}, {0.3, 0.5, 0.65}, poster(random));
  person.blob({0.0, 0.0, 1.65}, {0.11, 0.09, 0.14}, plain(150.0, 10.0, 22));
  scene.world.movers = {{[](double t) {
                           Attitude a;
                           a.position = {4.0 * std::cos(0.25 * t), 6.5 * std::sin(0.25 * t), 0.0};
                           a.yaw = 0.25 * t;
                           return a.pose();
                         },
                         person.finish()}};
  Walk round;
  round.corners = {{-9.0, -5.5}, {9.0, -5.5}, {9.0, 5.5}, {-9.0, 5.5},
                   {-9.0, -5.5}, {9.0, -5.5}, {9.0, 5.5}};
  round.corner_m = 3.0;
  round.head_turn_rad = 0.7;
  scene.T_world_lidar = walk(round);
  return scene;
}

}  // namespace sparsight::synthetic
