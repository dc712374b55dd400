#include <cmath>

#include "tests/synthetic/scenes/builder.h"
#include "tests/synthetic/scenes/motions.h"
#include "tests/synthetic/scenes/palette.h"
#include "tests/synthetic/scenes/rigs.h"
#include "tests/synthetic/scenes/scenes.h"

namespace sparsight::synthetic {
namespace {

// A ring of corridors around a block; the walk follows its middle, to the left.
constexpr double kLength = 20.0;
constexpr double kBreadth = 13.0;
constexpr double kWidth = 2.2;
constexpr double kHeight = 2.7;
constexpr double kDoorEvery = 3.6;

// One corridor: begins at `origin`, runs along `yaw`, the block on its left.
struct Wing {
  Eigen::Vector2d origin;
  double yaw;
  double length;
  double contrast;  // of its walls

  Eigen::Vector3d at(double along, double left, double up) const {
    const Eigen::Vector2d p = origin + Eigen::Rotation2Dd(yaw) * Eigen::Vector2d(along, left);
    return {p.x(), p.y(), up};
  }
};

void add_door(Builder& builder, const Wing& wing, double along, double side, Random& random) {
  const double wall = side * kWidth / 2.0;
  const MaterialRef frame = plain(90.0, 3.0, random.bits());
  builder.box(wing.at(along, wall, 0.0), {0.9, 0.05, 2.05}, door(random), wing.yaw);
  for (const double x : {-0.5, 0.5}) {
    builder.box(wing.at(along + x, wall, 0.0), {0.1, 0.12, 2.15}, frame, wing.yaw);
  }
  builder.box(wing.at(along, wall, 2.05), {1.1, 0.12, 0.1}, frame, wing.yaw);
}

void add_fittings(Builder& builder, const Wing& wing, double along, double side, Random& random) {
  const double wall = side * (kWidth / 2.0 - 0.02);
  if (random.chance(0.45)) {
    builder.box(wing.at(along, wall, 1.2), {random.uniform(0.4, 1.1), 0.02, 0.7}, poster(random),
                wing.yaw);
  }
  if (random.chance(0.2)) {
    builder.box(wing.at(along + 0.7, side * (kWidth / 2.0 - 0.15), 0.0), {0.45, 0.3, 0.9},
                cardboard(random), wing.yaw);
  }
  if (random.chance(0.2)) {
    builder.post(wing.at(along - 0.7, side * (kWidth / 2.0 - 0.1), 0.5), 0.08, 0.5,
                 plain(70.0, 12.0, random.bits()));
  }
}

void add_wing(Builder& builder, const Wing& wing, Random& random) {
  const double middle = wing.length / 2.0;
  for (const double side : {-1.0, 1.0}) {
    // The inner wall ends where the next corridor begins; the outer one goes round the corner.
    const double length = side > 0 ? wing.length - kWidth : wing.length + kWidth;
    builder.box(wing.at(middle, side * (kWidth / 2.0 + 0.15), 0.0), {length, 0.3, kHeight},
                plaster(random, wing.contrast), wing.yaw);
    for (double along = 2.2; along < wing.length - 1.6; along += kDoorEvery) {
      add_door(builder, wing, along, side, random);
      add_fittings(builder, wing, along + kDoorEvery / 2.0, side, random);
    }
  }
}

std::vector<Wing> wings() {
  return {{{0.0, 0.0}, 0.0, kLength, 7.0},
          {{kLength, 0.0}, M_PI / 2.0, kBreadth, 2.0},
          {{kLength, kBreadth}, M_PI, kLength, 5.0},
          {{0.0, kBreadth}, -M_PI / 2.0, kBreadth, 2.0}};
}

}  // namespace

Scene make_corridor(std::uint64_t seed) {
  Random random(seed ^ 0xc0441d04U);
  Builder builder;
  for (const Wing& wing : wings()) add_wing(builder, wing, random);
  const Eigen::Vector3d middle(kLength / 2.0, kBreadth / 2.0, 0.0);
  builder.box(middle + Eigen::Vector3d(0, 0, kHeight), {kLength + 4.0, kBreadth + 4.0, 0.2},
              ceiling(random));
  Scene scene;
  scene.rig = hand_held_rig();
  scene.sensor = vlp16();
  scene.world.ground = floor_tiles(random, 0.6, 5.0);
  scene.world.still = builder.finish();
  scene.world.light = {Eigen::Vector3d(0.25, 0.4, 0.6).normalized(), 0.85, 0.35, false};
  scene.imager.noise_grey = 1.5;
  scene.imager.vignetting = 0.15;
  Walk lap;
  lap.corners = {{1.0, 0.0}, {kLength, 0.0}, {kLength, kBreadth}, {0.0, kBreadth},
                 {0.0, 0.0}, {kLength, 0.0}, {kLength, kBreadth}};
  scene.T_world_lidar = walk(lap);
  return scene;
}

Scene make_exposure(std::uint64_t seed) {
  Scene scene = make_corridor(seed);
  // Drift by a quarter within seconds, and jumps where a camera would change its shutter.
  scene.imager.brightness = [](double t) {
    double gain = 1.0 + 0.25 * std::sin(2.0 * M_PI * t / 7.0);
    double offset = 4.0 * std::sin(2.0 * M_PI * t / 11.0);
    if (std::fmod(t, 9.0) > 6.0) gain *= 0.7;
    if (std::fmod(t, 14.0) > 12.5) offset += 15.0;
    return Eigen::Vector2d(gain, offset);
  };
  return scene;
}

}  // namespace sparsight::synthetic
