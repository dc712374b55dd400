#include "drivers/simulated/street.h"

#include <algorithm>
#include <cmath>

#include "drivers/simulated/palette.h"
#include "drivers/simulated/scene_builder.h"

namespace sparsight::simulated {
namespace {

using Eigen::Vector3f;

constexpr float kStreetHalfLength = 42.0F;
constexpr float kFacade = 8.2F;  // from the middle of the road
constexpr float kKerb = 4.2F;
constexpr float kKerbHeight = 0.12F;
constexpr float kFloor = 3.1F;
constexpr float kRecess = 0.16F;
constexpr float kCrossing = 28.4F;  // where people walk over the road, from the street's middle

bool in_the_way(float x) { return std::abs(std::abs(x) - kCrossing) < 1.2F; }

// The front of a house: `along` to the right as seen from the street.
struct Front {
  Vector3f corner;
  Vector3f along;
  float length;
  int floors;
  int wall;

  float height() const { return 0.5F + kFloor * static_cast<float>(floors); }
  Vector3f into() const { return Vector3f(0, 0, 1).cross(along); }
  Vector3f at(float x, float z, float depth = 0.0F) const {
    return corner + x * along + Vector3f(0, 0, z) + depth * into();
  }
  float yaw() const { return std::atan2(along.y(), along.x()); }
};

struct Opening {
  float from;
  float to;
  float low;
  float high;
};

class StreetBuilder {
 public:
  StreetBuilder(Scene& scene, std::uint64_t seed)
      : build_(scene, seed), random_(build_.random()), palette_(scene.library, random_) {
    trim_ = palette_.plain(0.62F, 0.1F, 0.08F, 60);
    metal_ = palette_.plain(0.3F, 0.05F, 0.06F, 60);
    bark_ = palette_.bark();
    tyre_ = palette_.plain(0.05F, 0.1F, 0.1F, 6);
    rim_ = palette_.plain(0.5F, 0.02F, 0.08F, 70);
    pane_ = palette_.tinted(palette_.plain(0.07F, 0.25F, 0.04F, 6), 210.0F, 0.25F);
    scene.library.materials[static_cast<std::size_t>(pane_)].dropout = 0.6F;
    for (int i = 0; i < 4; ++i) glass_.push_back(palette_.glass());
    scene.daylight.clouds = palette_.clouds();
  }

  void build() {
    ground();
    for (const float side : {-1.0F, 1.0F}) {
      row({-side * kStreetHalfLength, side * kFacade, 0}, {side, 0, 0}, 2 * kStreetHalfLength);
      row({side * kStreetHalfLength, side * kFacade, 0}, {0, -side, 0}, 2 * kFacade);
      furniture(side);
      cars(side);
    }
  }

 private:
  void ground() {
    const int road = palette_.asphalt();
    const int paving = palette_.paving();
    const int kerb = palette_.plain(0.5F, 0.15F, 0.15F, 40);
    const int paint = palette_.plain(0.75F, 0.15F, 0.12F, 95);
    const float a = kStreetHalfLength;
    build_.panel({-a, -kKerb, 0}, {2 * a, 0, 0}, {0, 2 * kKerb, 0}, road);
    const float width = kFacade - kKerb;
    build_.panel({-a, kKerb, kKerbHeight}, {2 * a, 0, 0}, {0, width, 0}, paving);
    build_.panel({-a, -kFacade, kKerbHeight}, {2 * a, 0, 0}, {0, width, 0}, paving);
    const float top = kKerbHeight + 0.003F;
    for (const float side : {-1.0F, 1.0F}) {
      build_.box({0, side * (kKerb + 0.07F), 0}, {2 * a, 0.15F, top}, 0.0F, kerb);
      for (const float x : {-kCrossing, kCrossing}) {
        for (float y = 0.5F; y < kKerb; y += 1.0F) {
          build_.panel({x - 1.5F, side * y - 0.25F, 0.002F}, {3.0F, 0, 0}, {0, 0.5F, 0}, paint);
        }
      }
    }
    for (float x = -24.0F; x < 24.0F; x += 5.0F) {
      build_.panel({x, -0.06F, 0.002F}, {2.2F, 0, 0}, {0, 0.12F, 0}, paint);
    }
    for (float x = -22.0F; x < 24.0F; x += 14.5F) {  // manholes
      build_.column({x, 1.2F, -0.002F}, 0.33F, 0.006F, 16, metal_);
    }
  }

  // Houses wall to wall.
  void row(const Vector3f& corner, const Vector3f& along, float length) {
    for (float x = 0.0F; x < length - 0.5F;) {
      float width = random_.uniform_f(7.5, 12.0);
      if (length - x - width < 6.0F) width = length - x;
      const int wall = random_.chance(0.3)
                           ? palette_.bricks()
                           : palette_.tinted_by_turns(
                                 palette_.plain(random_.uniform_f(0.38, 0.68), 0.2F, 0.16F, 50),
                                 {34.0F, 18.0F, 48.0F, 205.0F, 95.0F}, 0.22F);
      house({corner + x * along, along, width, 2 + random_.index(3), wall});
      x += width;
    }
  }

  void house(const Front& front) {
    const float spacing = random_.uniform_f(2.0, 2.6);
    const int columns = std::max(2, static_cast<int>((front.length - 0.8F) / spacing));
    const float step = front.length / static_cast<float>(columns);
    const int pane =
        glass_[static_cast<std::size_t>(random_.index(static_cast<int>(glass_.size())))];
    const int door_column = random_.index(columns);
    build_.panel(front.at(0, front.height() - 0.5F), front.length * front.along, {0, 0, 0.5F},
                 front.wall);
    for (int floor = 0; floor < front.floors; ++floor) {
      const float base = kFloor * static_cast<float>(floor);
      float from = 0.0F;
      for (int column = 0; column < columns; ++column) {
        const float middle = (static_cast<float>(column) + 0.5F) * step;
        const bool door = floor == 0 && column == door_column;
        const float half = door ? 0.55F : 0.6F;
        const Opening opening{middle - half, middle + half, base + (door ? kKerbHeight : 1.0F),
                              base + (door ? 2.4F : 2.5F)};
        build_.panel(front.at(from, base), (opening.from - from) * front.along, {0, 0, kFloor},
                     front.wall);
        cut(front, opening, base, door ? palette_.door({1.1F, 2.28F}) : pane);
        from = opening.to;
      }
      build_.panel(front.at(from, base), (front.length - from) * front.along, {0, 0, kFloor},
                   front.wall);
      if (floor == 0) {
        build_.box(front.at(front.length / 2, kFloor - 0.1F, 0.0F), {front.length, 0.16F, 0.14F},
                   front.yaw(), trim_);
      }
    }
    crown(front);
  }

  void cut(const Front& front, const Opening& o, float base, int back) {
    const Vector3f right = (o.to - o.from) * front.along;
    const Vector3f in = kRecess * front.into();
    const Vector3f up(0, 0, o.high - o.low);
    build_.panel(front.at(o.from, base), right, {0, 0, o.low - base}, front.wall);
    build_.panel(front.at(o.from, o.high), right, {0, 0, base + kFloor - o.high}, front.wall);
    build_.panel(front.at(o.from, o.low) + in, right, up, back);
    build_.panel(front.at(o.from, o.low), in, up, trim_);
    build_.panel(front.at(o.to, o.low) + in, -in, up, trim_);
    build_.panel(front.at(o.from, o.high) + in, right, -in, trim_);
    build_.panel(front.at(o.from, o.low), right, in, trim_);
    if (o.low - base > 0.5F) {
      build_.box(front.at((o.from + o.to) / 2, o.low - 0.07F, -0.06F),
                 {o.to - o.from + 0.2F, 0.16F, 0.07F}, front.yaw(), trim_);
      if (base > 1.0F && random_.chance(0.12)) balcony(front, o, base);
    } else {
      build_.box(front.at((o.from + o.to) / 2, 0.0F, -0.15F),
                 {o.to - o.from + 0.3F, 0.35F, kKerbHeight + 0.1F}, front.yaw(), trim_);
    }
  }

  void balcony(const Front& front, const Opening& o, float base) {
    const float middle = (o.from + o.to) / 2;
    build_.box(front.at(middle, base - 0.1F, -0.45F), {1.9F, 0.9F, 0.14F}, front.yaw(), trim_);
    build_.box(front.at(middle, base + 0.04F, -0.88F), {1.9F, 0.04F, 0.9F}, front.yaw(), slats());
  }

  void crown(const Front& front) {
    const float height = front.height();
    build_.box(front.at(front.length / 2, height - 0.3F, -0.05F), {front.length, 0.5F, 0.3F},
               front.yaw(), trim_);
    // What of the house is seen above lower neighbours, of which none is lower than two floors.
    constexpr float kHidden = 6.0F;
    build_.box(front.at(front.length / 2, kHidden, 4.3F),
               {front.length - 0.02F, 8.0F, height - kHidden - 0.02F}, front.yaw(), front.wall);
    for (const float x : {0.01F, front.length - 0.01F}) {
      build_.panel(front.at(x, kHidden), 0.4F * front.into(), {0, 0, height - kHidden}, front.wall);
    }
    build_.column(front.at(0.15F, 0.0F, -0.09F), 0.05F, height - 0.3F, 8, metal_);
    if (random_.chance(0.6)) {
      const Eigen::Vector2f size(random_.uniform_f(1.4, 2.6), 0.5F);
      const float x = random_.uniform_f(0.6, front.length - 3.2);
      build_.panel(front.at(x, 2.62F, -0.03F), size.x() * front.along, {0, 0, 0.4F},
                   palette_.sign(size, false));
    }
  }

  int slats() {
    if (slats_ < 0) slats_ = palette_.slats(0.12F);
    return slats_;
  }

  void furniture(float side) {
    const int leaves = palette_.leaves(random_.uniform_f(0.26, 0.38));
    for (float x = -34.0F; x < 35.0F; x += random_.uniform_f(9.0, 13.0)) {
      if (in_the_way(x)) continue;
      const Vector3f foot(x, side * (kKerb + 0.75F), kKerbHeight);
      build_.column(foot, 0.17F, 3.4F, 10, bark_, 0.10F);
      build_.column(foot, 0.5F, 0.03F, 10, palette_.plain(0.2F, 0.2F, 0.3F, 20));
      const float size = random_.uniform_f(0.85, 1.2);
      build_.foliage(foot + Vector3f(0, 0, 4.3F), size * Vector3f(1.7F, 1.5F, 1.5F), 1900, 0.19F,
                     leaves);
      const Vector3f beside =
          foot + Vector3f{random_.uniform_f(2.5, 4.5), random_.uniform_f(-0.1, 0.1), 0.0F};
      if (in_the_way(beside.x())) continue;
      switch (random_.index(4)) {
        case 0:
          lamp_post(beside, side);
          break;
        case 1:
          sign_post(beside);
          break;
        case 2:
          build_.column(beside, 0.22F, 0.9F, 12, metal_, 0.25F);
          break;
        default:
          bench(beside);
          break;
      }
    }
    for (float x = -30.0F; x < 32.0F; x += 4.4F) {
      if (random_.chance(0.45) && !in_the_way(x))
        build_.column({x, side * (kKerb + 0.35F), kKerbHeight}, 0.06F, 0.85F, 10, metal_);
      if (random_.chance(0.3)) {
        const float width = random_.uniform_f(0.5, 1.0);
        build_.box({x + 1.0F, side * (kFacade - 0.4F), kKerbHeight}, {width, 0.5F, 0.9F}, 0.0F,
                   palette_.cardboard({width, 0.9F}));
      }
      if (random_.chance(0.25)) {  // a plant before a house
        const Vector3f foot(x, side * (kFacade - 0.35F), kKerbHeight);
        build_.column(foot, 0.2F, 0.45F, 10, trim_, 0.25F);
        build_.foliage(foot + Vector3f(0, 0, 0.85F), {0.4F, 0.35F, 0.5F}, 260, 0.12F, leaves);
      }
    }
  }

  void lamp_post(const Vector3f& foot, float side) {
    build_.column(foot, 0.07F, 5.2F, 10, metal_, 0.05F);
    build_.box(foot + Vector3f(0, -side * 0.5F, 5.1F), {0.25F, 1.0F, 0.12F}, 0.0F, metal_);
  }

  void sign_post(const Vector3f& foot) {
    build_.column(foot, 0.035F, 2.9F, 8, metal_);
    const Eigen::Vector2f size(0.6F, 0.6F);
    const int sign = palette_.sign(size, true);
    build_.panel(foot + Vector3f(-0.04F, 0.3F, 2.2F), {0, -0.6F, 0}, {0, 0, 0.6F}, sign);
    build_.panel(foot + Vector3f(0.04F, -0.3F, 2.2F), {0, 0.6F, 0}, {0, 0, 0.6F}, sign);
  }

  void bench(const Vector3f& foot) {
    if (boards_ < 0) boards_ = palette_.boards();
    build_.box(foot + Vector3f(0, 0, 0.42F), {1.7F, 0.42F, 0.05F}, 0.0F, boards_);
    for (const float x : {-0.7F, 0.7F})
      build_.box(foot + Vector3f(x, 0, 0), {0.08F, 0.4F, 0.42F}, 0.0F, metal_);
  }

  void cars(float side) {
    for (float x = -23.0F; x < 22.0F; x += random_.uniform_f(5.6, 8.5)) {
      if (random_.chance(0.75))
        car({x, side * (kKerb - 1.05F), 0.0F}, side, random_.uniform_f(0.93, 1.15));
    }
  }

  // Looks along x (or back); the windows slope.
  void car(const Vector3f& foot, float way, float scale) {
    const int paint =
        palette_.tinted_by_turns(palette_.plain(random_.chance(0.5) ? random_.uniform_f(0.14, 0.3)
                                                                    : random_.uniform_f(0.45, 0.75),
                                                0.12F, 0.03F, 55),
                                 {0.0F, 216.0F, 210.0F, 45.0F, 140.0F}, 0.6F);
    const float h = scale * random_.uniform_f(0.95, 1.15);
    const auto at = [&](float x, float y, float z) -> Vector3f {
      return foot + Vector3f(way * x * scale, way * y, z * h);
    };
    const float w = 0.86F;
    // Profile: bumper, bonnet, windscreen, roof, rear window, boot.
    const std::array<std::array<float, 2>, 8> profile{{{2.1F, 0.22F},
                                                       {2.15F, 0.62F},
                                                       {1.95F, 0.78F},
                                                       {1.0F, 0.92F},
                                                       {0.3F, 1.42F},
                                                       {-1.1F, 1.44F},
                                                       {-1.85F, 0.98F},
                                                       {-2.15F, 0.9F}}};
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
      const auto& a = profile[i];
      const auto& b = profile[i + 1];
      const bool window = i == 3 || i == 5;
      build_.quad({at(a[0], -w, a[1]), at(a[0], w, a[1]), at(b[0], w, b[1]), at(b[0], -w, b[1])},
                  window ? pane_ : paint);
    }
    build_.quad(
        {at(-2.15F, w, 0.22F), at(-2.15F, -w, 0.22F), at(-2.15F, -w, 0.9F), at(-2.15F, w, 0.9F)},
        paint);
    for (const float s : {-1.0F, 1.0F}) {
      const auto side_quad = [&](float x0, float z0, float x1, float z1, float x2, float z2,
                                 float x3, float z3, float out, int material) {
        std::array<Vector3f, 4> corners{at(x0, s * out, z0), at(x1, s * out, z1),
                                        at(x2, s * out, z2), at(x3, s * out, z3)};
        if (s > 0) std::swap(corners[1], corners[3]);
        build_.quad(corners, material);
      };
      side_quad(-2.15F, 0.22F, 2.1F, 0.22F, 2.1F, 0.7F, -2.15F, 0.9F, w, paint);
      side_quad(-2.15F, 0.9F, 2.1F, 0.7F, 1.0F, 0.92F, -1.85F, 0.98F, w, paint);
      side_quad(-1.85F, 0.98F, 1.0F, 0.92F, 0.3F, 1.42F, -1.1F, 1.44F, w, paint);
      side_quad(-1.0F, 1.0F, -0.1F, 0.98F, -0.1F, 1.34F, -0.85F, 1.36F, w + 0.006F, pane_);
      side_quad(0.0F, 0.98F, 0.78F, 0.97F, 0.28F, 1.34F, 0.0F, 1.35F, w + 0.006F, pane_);
      for (const float x : {-1.35F, 1.3F}) {
        const Vector3f hub = at(x, s * (w - 0.16F), 0.0F) + Vector3f(0, 0, 0.31F);
        const Vector3f out(0, way * s * 0.18F, 0);
        build_.roller(hub, hub + out, 0.31F, 16, tyre_, tyre_);
        build_.roller(hub, hub + 1.03F * out, 0.19F, 12, rim_, rim_);
      }
      build_.quad({at(2.155F, s * 0.55F - 0.16F, 0.5F), at(2.155F, s * 0.55F + 0.16F, 0.5F),
                   at(2.145F, s * 0.55F + 0.16F, 0.62F), at(2.145F, s * 0.55F - 0.16F, 0.62F)},
                  trim_);
    }
    if (plate_ < 0) plate_ = palette_.sign({0.5F, 0.12F}, true);
    build_.quad({at(2.13F, -0.25F, 0.34F), at(2.13F, 0.25F, 0.34F), at(2.14F, 0.25F, 0.45F),
                 at(2.14F, -0.25F, 0.45F)},
                plate_);
    build_.quad({at(-2.16F, 0.25F, 0.5F), at(-2.16F, -0.25F, 0.5F), at(-2.16F, -0.25F, 0.62F),
                 at(-2.16F, 0.25F, 0.62F)},
                plate_);
  }

  SceneBuilder build_;
  Random& random_;
  Palette palette_;
  std::vector<int> glass_;
  int trim_;
  int metal_;
  int bark_;
  int tyre_;
  int rim_;
  int pane_;
  int slats_ = -1;
  int boards_ = -1;
  int plate_ = -1;
};

}  // namespace

Scene make_street(std::uint64_t seed) {
  Scene scene;
  StreetBuilder(scene, seed ^ 0x574ee7U).build();
  scene.daylight.sun = 0.9F;
  scene.daylight.sky = 0.85F;
  scene.daylight.towards_sun = {0.62F, -0.3F, 0.72F};
  scene.bounced_light = 0.55F;
  scene.light_spacing_m = 0.3F;
  scene.exposure_gain = 290.0F;
  scene.walk.corners = {{-kCrossing, -6.3}, {kCrossing, -6.3}, {kCrossing, 6.3}, {-kCrossing, 6.3}};
  scene.walk.corner_m = 2.0;
  scene.walk.height_m = 1.55 + kKerbHeight;
  scene.walk.speed_m_s = 1.2;
  scene.walk.look_yaw_deg = 45.0;
  return scene;
}

}  // namespace sparsight::simulated
