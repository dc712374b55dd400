#include <algorithm>
#include <cmath>

#include "tests/synthetic/scenes/builder.h"
#include "tests/synthetic/scenes/motions.h"
#include "tests/synthetic/scenes/palette.h"
#include "tests/synthetic/scenes/rigs.h"
#include "tests/synthetic/scenes/scenes.h"

namespace sparsight::synthetic {
namespace {

// Speed falls from 11 m/s to zero in 5 s, stays zero until 9.5 s, then grows to 11 m/s in 5.5 s.
constexpr double kStopBegins = 0.5;
constexpr double kStands = 5.5;
constexpr double kStarts = 9.7;
constexpr double kFast = 15.2;
constexpr double kDriveSpeed = 11.0;

// Distance covered in a change of speed that takes `duration`, `t` after its begin: the speed
// follows a half cosine, so that the acceleration has no jump.
double ramp(double t, double duration) {
  const double x = std::clamp(t, 0.0, duration);
  return x / 2.0 - duration / (2.0 * M_PI) * std::sin(M_PI * x / duration);
}

double along(double t) {
  const double braking = kStands - kStopBegins;
  double s = kDriveSpeed * t;
  s -= kDriveSpeed * (ramp(t - kStopBegins, braking) + std::max(0.0, t - kStands));
  s += kDriveSpeed * (ramp(t - kStarts, kFast - kStarts) + std::max(0.0, t - kFast));
  return s;
}

constexpr double kStopped = 33.0;              // along(kStands)
constexpr double kCrossing = kStopped + 10.0;  // x of the middle of the near lane across

void add_blocks(Builder& builder, Random& random) {
  for (const double side : {-1.0, 1.0}) {
    for (double x = -40.0; x < 260.0;) {
      const double width = random.uniform(9.0, 18.0);
      const bool crossing = x + width > kCrossing - 9.0 && x < kCrossing + 9.0;
      if (!crossing) {
        const double setback = random.uniform(11.0, 14.0);
        builder.box({x + width / 2.0, side * (setback + 5.0), 0.0},
                    {width, 10.0, random.uniform(6.0, 14.0)}, facade(random));
      }
      if (!crossing && random.chance(0.6)) {
        builder.tree({x + 2.0, side * 8.5, 0.0}, random.uniform(4.0, 8.0), random);
      }
      x += width + random.uniform(0.5, 4.0);
    }
    builder.post({kCrossing - 7.0, side * 6.6, 0.0}, 0.07, 3.4, metal(random));
    builder.box({kCrossing - 7.1, side * 6.6, 2.5}, {0.3, 0.35, 0.9}, plate(random));
    builder.post({kCrossing + 7.0, side * 6.6, 0.0}, 0.07, 3.4, metal(random));
    builder.box({kCrossing + 6.9, side * 6.6, 2.5}, {0.3, 0.35, 0.9}, tyre());
  }
}

// Crosses from one side to the other, in the middle of the picture at `when`.
Mover crossing(double x, double when, double speed, double length, double height, Random& random) {
  const double yaw = speed > 0 ? M_PI / 2.0 : -M_PI / 2.0;
  return {[=](double t) {
            Attitude a;
            a.position = {x, speed * (t - when), 0.0};
            a.yaw = yaw;
            return a.pose();
          },
          make_car(random, length, height)};
}

// Waits beside us, and leaves before we do.
Mover neighbour(double left, double stands_at, double leaves, double length, double height,
                Random& random) {
  return {[=](double t) {
            Attitude a;
            const double gone = std::max(0.0, t - leaves);
            a.position = {stands_at + 0.9 * gone * gone, left, 0.0};
            return a.pose();
          },
          make_car(random, length, height)};
}

}  // namespace

Scene make_lights(std::uint64_t seed) {
  Random random(seed ^ 0x11647U);
  Builder builder;
  add_blocks(builder, random);
  Scene scene;
  scene.rig = kitti_rig();
  scene.sensor = hdl64();
  scene.world.ground =
      road({.half_width = 7.5,
            .verge_tone = 35.0,
            .verge_grain = 10.0,
            .line_tone = 95.0,
            .lines = {{0.0, 0.12, 6.0, 0.5}, {-3.6, 0.12, 6.0, 0.5}, {7.3, 0.2}, {-7.3, 0.2}}},
           9.0);
  scene.world.still = builder.finish();
  scene.world.movers = {crossing(kCrossing, 5.6, 5.0, 4.6, 1.6, random),
                        crossing(kCrossing - 0.5, 7.2, 3.5, 7.0, 2.9, random),
                        crossing(kCrossing + 3.2, 6.3, -6.0, 4.4, 1.5, random),
                        crossing(kCrossing + 3.4, 8.6, -4.0, 6.0, 2.4, random),
                        crossing(kCrossing - 0.3, 9.4, 6.0, 5.0, 2.0, random),
                        neighbour(-5.4, kStopped + 4.5, 8.8, 5.2, 2.2, random),
                        neighbour(-1.8, kStopped + 22.0, 2.0, 4.5, 1.5, random)};
  scene.T_world_lidar = drive({}, -1.8, along, 45.0);
  return scene;
}

}  // namespace sparsight::synthetic
