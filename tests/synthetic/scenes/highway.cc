#include <cmath>

#include "tests/synthetic/scenes/builder.h"
#include "tests/synthetic/scenes/motions.h"
#include "tests/synthetic/scenes/palette.h"
#include "tests/synthetic/scenes/rigs.h"
#include "tests/synthetic/scenes/scenes.h"

namespace sparsight::synthetic {
namespace {

constexpr double kBegin = -60.0;
constexpr double kEnd = 1800.0;
constexpr double kLane = 3.6;
constexpr double kSpeed = 28.0;

void add_rails(Builder& builder, const RoadBend& bend, Random& random) {
  constexpr double kPiece = 4.0;
  const MaterialRef rail = metal(random);
  for (const double left : {-7.6, 7.6, 10.4, 25.6}) {
    for (double u = kBegin; u < kEnd; u += kPiece) {
      const Eigen::Isometry3d T = on_road(bend, left, u);
      const double yaw = std::atan(bend.slope(u));
      builder.box(T.translation() + Eigen::Vector3d(0, 0, 0.45), {kPiece, 0.08, 0.31}, rail, yaw);
      builder.box(T.translation(), {0.1, 0.12, 0.7}, rail, yaw);
    }
  }
}

void add_gantry(Builder& builder, const RoadBend& bend, double u, Random& random) {
  const double yaw = std::atan(bend.slope(u));
  const MaterialRef steel = metal(random);
  for (const double left : {-9.0, 9.0}) {
    builder.post(on_road(bend, left, u).translation(), 0.2, 6.8, steel);
  }
  const Eigen::Vector3d middle = on_road(bend, 0.0, u).translation();
  builder.box(middle + Eigen::Vector3d(0, 0, 6.4), {0.4, 18.0, 0.4}, steel, yaw);
  builder.box(on_road(bend, -3.0, u).translation() + Eigen::Vector3d(0, 0, 5.5), {0.1, 5.0, 2.2},
              poster(random), yaw);
}

void add_surroundings(Builder& builder, const RoadBend& bend, Random& random) {
  for (double u = kBegin; u < kEnd; u += random.uniform(8.0, 30.0)) {
    const double side = random.chance(0.5) ? -1.0 : 1.0;
    const double left = side > 0 ? random.uniform(32.0, 70.0) : -random.uniform(13.0, 50.0);
    const double height = random.uniform(3.0, 10.0);
    if (random.chance(0.7)) {
      builder.tree(on_road(bend, left, u).translation(), height, random);
    } else {
      builder.blob(on_road(bend, left, u).translation(), {random.uniform(3.0, 12.0), 3.0, 2.2},
                   foliage(random));
    }
  }
  for (double u = kBegin; u < kEnd; u += 50.0) {
    builder.box(on_road(bend, -8.4, u).translation(), {0.05, 0.12, 1.0}, plate(random),
                std::atan(bend.slope(u)));
  }
  for (double u = 140.0; u < kEnd; u += 310.0) add_gantry(builder, bend, u, random);
}

Mover companion(const RoadBend& bend, double left, double ahead, double speed, double surge,
                Random& random) {
  const bool lorry = left < -3.0;
  return {[=](double t) {
            const double along = kSpeed * 1.0 + ahead + speed * t + surge * std::sin(0.3 * t);
            return on_road(bend, left, along);
          },
          lorry ? make_car(random, 11.0, 3.6) : make_car(random)};
}

}  // namespace

Scene make_highway(std::uint64_t seed) {
  Random random(seed ^ 0x4157U);
  const RoadBend bend{random.uniform(25.0, 40.0), random.uniform(1400.0, 1900.0)};
  Builder builder;
  add_rails(builder, bend, random);
  add_surroundings(builder, bend, random);
  Scene scene;
  scene.rig = kitti_rig();
  scene.sensor = hdl64();
  scene.world.ground = road(
      {.bend = bend,
       .half_width = 7.4,
       .verge_tone = 12.0,
       .verge_grain = 14.0,
       .line_tone = 90.0,
       .lines = {{-5.4, 0.3}, {-1.8, 0.15, 18.0, 0.333}, {1.8, 0.15, 18.0, 0.333}, {5.4, 0.3}}},
      4.0);
  scene.world.still = builder.finish();
  // Along the right lane a lorry, around us cars at nearly our speed, on the far side a
  // counterflow.
  scene.world.movers = {companion(bend, -kLane, 34.0, 24.5, 0.0, random),
                        companion(bend, 0.0, 24.0, kSpeed + 0.5, 3.0, random),
                        companion(bend, kLane, 6.0, kSpeed + 1.2, 2.0, random),
                        companion(bend, kLane, -30.0, kSpeed + 3.5, 0.0, random),
                        companion(bend, kLane, 52.0, kSpeed - 0.8, 4.0, random)};
  for (double start = 90.0; start < 1500.0; start += random.uniform(60.0, 160.0)) {
    scene.world.movers.push_back({[bend, start](double t) {
                                    return on_road(bend, 18.0, start - 30.0 * t) *
                                           Eigen::Isometry3d(
                                               Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()));
                                  },
                                  make_car(random)});
  }
  scene.T_world_lidar = drive(
      bend, 0.0, [](double t) { return kSpeed * t + 2.0 * std::sin(0.2 * t); }, 45.0);
  return scene;
}

}  // namespace sparsight::synthetic
