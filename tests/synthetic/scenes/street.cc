#include <cmath>

#include "tests/synthetic/scenes/builder.h"
#include "tests/synthetic/scenes/motions.h"
#include "tests/synthetic/scenes/palette.h"
#include "tests/synthetic/scenes/rigs.h"
#include "tests/synthetic/scenes/scenes.h"

namespace sparsight::synthetic {
namespace {

constexpr double kStreetBegin = -30.0;
constexpr double kStreetEnd = 700.0;

struct Site {
  Eigen::Vector3d foot;
  double yaw;
};

Site beside(const RoadBend& bend, double left_m, double along_m) {
  const Eigen::Isometry3d T = on_road(bend, left_m, along_m);
  return {T.translation(), std::atan(bend.slope(along_m))};
}

void add_buildings(Builder& builder, const RoadBend& bend, double side, Random& random) {
  for (double u = kStreetBegin; u < kStreetEnd;) {
    const double width = random.uniform(9.0, 22.0);
    const double depth = random.uniform(8.0, 12.0);
    const double setback = random.uniform(9.5, 14.0);
    const double height = random.uniform(5.0, 14.0);
    const Site site = beside(bend, side * (setback + depth / 2.0), u + width / 2.0);
    builder.box(site.foot, {width, depth, height}, facade(random), site.yaw);
    // A porch or bay in front of it.
    const Site bay = beside(bend, side * (setback - 0.5), u + width * random.uniform(0.2, 0.8));
    builder.box(bay.foot, {random.uniform(1.5, 3.5), 1.4, random.uniform(2.4, 4.0)}, brick(random),
                bay.yaw);
    u += width + (random.chance(0.3) ? random.uniform(4.0, 15.0) : random.uniform(0.3, 2.0));
  }
}

void add_roadside(Builder& builder, const RoadBend& bend, double side, Random& random) {
  for (double u = kStreetBegin; u < kStreetEnd; u += random.uniform(5.5, 13.0)) {
    if (random.chance(0.55)) {
      const Site car = beside(bend, side * 4.9, u);
      add_car(builder, car.foot, car.yaw + (side > 0 ? M_PI : 0.0) + random.gaussian(0.02), random,
              random.uniform(3.8, 5.2), random.uniform(1.4, 2.1));
    }
    if (random.chance(0.5)) {
      builder.tree(beside(bend, side * 7.4, u + 3.0).foot, random.uniform(5.0, 9.0), random);
    }
    if (random.chance(0.35)) {
      const Site post = beside(bend, side * 6.4, u + 1.5);
      builder.post(post.foot, 0.05, 3.0, metal(random));
      builder.box(post.foot + Eigen::Vector3d(0, 0, 2.3), {0.06, 0.7, 0.7}, plate(random),
                  post.yaw);
    }
    if (random.chance(0.3)) {
      const Site hedge = beside(bend, side * 8.4, u);
      builder.box(hedge.foot, {random.uniform(3.0, 7.0), 0.7, random.uniform(0.8, 1.5)},
                  foliage(random), hedge.yaw);
    }
  }
}

}  // namespace

Scene make_street(std::uint64_t seed) {
  Random random(seed);
  const RoadBend bend{random.uniform(14.0, 20.0), random.uniform(230.0, 280.0)};
  Builder builder;
  for (const double side : {-1.0, 1.0}) {
    add_buildings(builder, bend, side, random);
    add_roadside(builder, bend, side, random);
  }
  Scene scene;
  scene.rig = kitti_rig();
  scene.sensor = hdl64();
  scene.world.ground = road({.bend = bend,
                             .half_width = 6.0,
                             .verge_tone = 38.0,
                             .verge_grain = 11.0,
                             .line_tone = 95.0,
                             .lines = {{0.0, 0.12, 6.0, 0.5}, {5.9, 0.2}, {-5.9, 0.2}}},
                            9.0);
  scene.world.still = builder.finish();
  // One car comes towards us, one drives ahead.
  scene.world.movers = {
      {[bend](double t) {
         return on_road(bend, 1.9, 120.0 - 9.0 * t) *
                Eigen::Isometry3d(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()));
       },
       make_car(random)},
      {[bend](double t) { return on_road(bend, -2.0, 22.0 + 12.5 * t); }, make_car(random)}};
  scene.T_world_lidar = drive(
      bend, -2.0, [](double t) { return 11.6 * t + 3.0 * std::sin(0.25 * t); }, 45.0);
  return scene;
}

}  // namespace sparsight::synthetic
