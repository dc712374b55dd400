#include <cmath>

#include "tests/synthetic/scenes/builder.h"
#include "tests/synthetic/scenes/motions.h"
#include "tests/synthetic/scenes/palette.h"
#include "tests/synthetic/scenes/rigs.h"
#include "tests/synthetic/scenes/scenes.h"

namespace sparsight::synthetic {
namespace {

constexpr double kDeskHeight = 0.74;

void add_room(Builder& builder, Random& random) {
  builder.box({2.6, 0.0, 0.0}, {0.2, 7.0, 2.8}, plaster(random, 6.0));
  builder.box({-3.4, 0.0, 0.0}, {0.2, 7.0, 2.8}, plaster(random, 6.0));
  builder.box({0.0, 3.2, 0.0}, {6.0, 0.2, 2.8}, plaster(random, 3.0));
  builder.box({0.0, -3.2, 0.0}, {6.0, 0.2, 2.8}, brick(random));
  builder.box({2.48, -0.9, 1.2}, {0.03, 1.0, 0.7}, poster(random));
  builder.box({2.48, 0.7, 1.3}, {0.03, 0.6, 0.8}, poster(random));
  builder.box({2.2, 2.3, 0.0}, {0.5, 1.2, 2.0}, wood(random));
  builder.box({0.4, -2.6, 0.0}, {0.9, 0.5, 1.1}, cardboard(random), 0.3);
}

void add_desk(Builder& builder, Random& random) {
  builder.box({1.3, 0.0, kDeskHeight - 0.03}, {0.9, 2.0, 0.03}, wood(random));
  for (const double y : {-0.9, 0.9}) builder.box({1.3, y, 0.0}, {0.7, 0.05, 0.7}, wood(random));
  const auto on_desk = [](double x, double y) { return Eigen::Vector3d(x, y, kDeskHeight); };
  builder.box(on_desk(1.5, 0.15), {0.04, 0.52, 0.40}, plain(45.0, 9.0, 31), 0.1);
  builder.box(on_desk(1.47, 0.15) + Eigen::Vector3d(0, 0, 0.05), {0.02, 0.46, 0.30}, poster(random),
              0.1);
  builder.box(on_desk(1.1, 0.1), {0.15, 0.44, 0.025}, poster(random), 0.05);
  for (int i = 0; i < 26; ++i) {
    const double x = random.uniform(0.92, 1.68);
    const double y = random.uniform(-0.9, 0.9);
    const double size = random.uniform(0.03, 0.16);
    const MaterialRef print = random.chance(0.5) ? poster(random) : cardboard(random);
    if (random.chance(0.3)) {
      builder.post(on_desk(x, y), 0.35 * size, 0.12, print);
    } else {
      builder.box(on_desk(x, y), {size, 1.3 * size, size * random.uniform(0.2, 1.5)}, print,
                  random.uniform(0.0, 3.0));
    }
  }
  builder.blob({1.2, -0.6, kDeskHeight + 0.07}, {0.07, 0.07, 0.07}, plain(120.0, 20.0, 41));
}

// The operator sweeps the camera about the desk: half a metre per second, half a radian.
Trajectory sweep() {
  constexpr double kStep = 0.25;
  std::vector<Attitude> knots;
  for (double t = 0.0; t <= 60.0; t += kStep) {
    Attitude a;
    a.position = {0.05 + 0.25 * std::sin(0.9 * t), 0.55 * std::sin(0.55 * t),
                  1.25 + 0.12 * std::sin(1.3 * t + 0.5)};
    a.yaw = -0.45 * std::sin(0.55 * t + 0.2) + 0.12 * std::sin(1.9 * t);
    a.pitch = 0.38 + 0.10 * std::sin(0.8 * t + 1.0);
    a.roll = 0.10 * std::sin(0.7 * t);
    knots.push_back(a);
  }
  Trajectory trajectory(knots, 0.0, kStep);
  trajectory.shake = [](double t) {
    Attitude a;
    a.position = {0.002 * std::sin(23.0 * t), 0.003 * std::sin(17.0 * t + 1.0),
                  0.003 * std::sin(19.0 * t + 2.0)};
    a.yaw = 0.004 * std::sin(21.0 * t);
    a.pitch = 0.004 * std::sin(25.0 * t + 0.7);
    a.roll = 0.003 * std::sin(15.0 * t + 0.3);
    return a;
  };
  return trajectory;
}

}  // namespace

Scene make_desk(std::uint64_t seed) {
  Random random(seed ^ 0xde5cU);
  Builder builder;
  add_room(builder, random);
  add_desk(builder, random);
  Scene scene;
  scene.rig = rgbd_rig();
  scene.sensor = DepthCamera{};
  scene.frame_rate_hz = 30.0;
  scene.world.ground = floor_tiles(random, 0.4, 6.0);
  scene.world.still = builder.finish();
  scene.world.light = {Eigen::Vector3d(0.3, 0.5, 0.8).normalized(), 0.75, 0.4, false};
  scene.imager.noise_grey = 1.5;
  scene.T_world_lidar = sweep();
  return scene;
}

}  // namespace sparsight::synthetic
