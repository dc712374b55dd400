#include "drivers/simulated/hall.h"

#include <array>
#include <cmath>

#include "drivers/simulated/palette.h"
#include "drivers/simulated/scene_builder.h"

namespace sparsight::simulated {
namespace {

using Eigen::Vector3f;

constexpr float kHallHalfLength = 13.0F;
constexpr float kHalfBreadth = 9.0F;
constexpr float kHallHeight = 6.4F;
constexpr float kBrickHeight = 1.4F;

class HallBuilder {
 public:
  HallBuilder(Scene& scene, std::uint64_t seed)
      : build_(scene, seed), random_(build_.random()), palette_(scene.library, random_) {
    steel_ = palette_.tinted(palette_.plain(0.42F, 0.06F, 0.08F, 65), 218.0F, 0.35F);
    paint_ = palette_.tinted(palette_.plain(0.7F, 0.1F, 0.15F, 80), 50.0F, 0.9F);
    wood_ = palette_.boards();
    concrete_ = palette_.plain(0.45F, 0.2F, 0.18F, 45);
  }

  void build() {
    shell();
    roof();
    for (const float x : {-6.0F, 0.0F, 6.0F}) pillar({x, 0.0F, 0.0F});
    for (const float x : {-9.5F, -3.2F, 3.2F, 9.5F}) {
      for (const float y : {-7.2F, 7.2F}) pillar({x, y, 0.0F});
    }
    for (const float x : {-10.5F, -6.3F, -0.2F, 6.4F}) {
      rack({x, kHalfBreadth - 0.55F, 0.0F}, 0.0F);
      if (x > -8.0F) rack({x + 0.4F, -kHalfBreadth + 0.55F, 0.0F}, 0.0F);
    }
    for (int i = 0; i < 9; ++i) {
      const float x = -5.4F + 1.35F * static_cast<float>(i) + random_.uniform_f(-0.3, 0.3);
      if (std::abs(std::remainder(x, 6.0F)) > 0.75F) stack({x, random_.uniform_f(-1.5, 1.5), 0.0F});
    }
    table({-3.0F, -1.9F, 0.0F}, 0.2F);
    table({3.4F, 1.8F, 0.0F}, -0.1F);
    for (const float y : {-3.2F, 0.5F, 3.4F}) stack({-kHallHalfLength + 0.9F, y, 0.0F});
  }

 private:
  void wall(const Vector3f& corner, const Vector3f& along, float length, int brick, int upper) {
    const Vector3f in(-along.y(), along.x(), 0.0F);
    build_.panel(corner, length * along, {0, 0, kBrickHeight}, brick);
    build_.panel(corner + Vector3f(0, 0, kBrickHeight), length * along,
                 {0, 0, kHallHeight - kBrickHeight}, upper);
    const float yaw = std::atan2(along.y(), along.x());
    const auto at = [&](float x, float z, float out) -> Vector3f {
      return corner + x * along + Vector3f(0, 0, z) - out * in;
    };
    build_.box(at(length / 2, kBrickHeight, 0.02F), {length, 0.08F, 0.06F}, yaw, steel_);
    for (float x = 2.2F; x + 2.4F < length; x += 4.3F) {
      const Eigen::Vector2f size(2.4F, 1.3F);
      build_.box(at(x + size.x() / 2, 4.3F - 0.06F, 0.0F),
                 {size.x() + 0.16F, 0.12F, size.y() + 0.12F}, yaw, steel_);
      build_.panel(at(x, 4.3F, 0.065F), size.x() * along, {0, 0, size.y()}, window_);
      if (random_.chance(0.55)) banner(at(x + random_.uniform_f(0.0, 1.2), 1.9F, 0.02F), along);
      build_.column(at(x - 0.9F, 0.0F, 0.12F), 0.055F, kHallHeight, 8, steel_);
    }
  }

  void banner(const Vector3f& low, const Vector3f& along) {
    const Eigen::Vector2f size{random_.uniform_f(0.9, 1.5), random_.uniform_f(1.4, 2.0)};
    build_.panel(low, size.x() * along, {0, 0, size.y()}, palette_.poster(size));
  }

  void shell() {
    const float a = kHallHalfLength;
    const float b = kHalfBreadth;
    window_ = palette_.window(0.9F);
    const int brick = palette_.bricks();
    const int upper = palette_.plain(0.6F, 0.14F, 0.09F, 55);
    const int upper_too = palette_.plain(0.5F, 0.12F, 0.12F, 50);
    wall({a, -b, 0}, {-1, 0, 0}, 2 * a, brick, upper);
    wall({-a, -b, 0}, {0, 1, 0}, 2 * b, brick, upper_too);
    wall({-a, b, 0}, {1, 0, 0}, 2 * a, brick, upper);
    wall({a, b, 0}, {0, -1, 0}, 2 * b, brick, upper_too);
    build_.panel({-a, -b, 0}, {2 * a, 0, 0}, {0, 2 * b, 0}, concrete_);
    for (const float y : {-5.9F, -3.1F, 3.1F, 5.9F}) {  // marked ways
      build_.panel({-10.0F, y - 0.05F, 0.002F}, {20.0F, 0, 0}, {0, 0.1F, 0}, paint_);
    }
    // A gate, and a door beside it.
    const int gate = palette_.slats(0.22F);
    build_.panel({a - 0.03F, 2.2F, 0}, {0, -4.4F, 0}, {0, 0, 3.8F}, gate);
    build_.box({a - 0.1F, 2.3F, 0}, {0.2F, 0.2F, 4.0F}, 0.0F, steel_);
    build_.box({a - 0.1F, -2.3F, 0}, {0.2F, 0.2F, 4.0F}, 0.0F, steel_);
    build_.box({a - 0.1F, 0.0F, 3.8F}, {0.2F, 4.6F, 0.3F}, 0.0F, steel_);
    const Eigen::Vector2f size(1.1F, 2.2F);
    build_.panel({a - 0.03F, -4.0F, 0}, {0, -size.x(), 0}, {0, 0, size.y()}, palette_.door(size));
  }

  void roof() {
    const int sheet = palette_.slats(0.5F);
    const int lamp = palette_.lamp(26.0F);
    build_.panel({-kHallHalfLength, kHalfBreadth, kHallHeight}, {2 * kHallHalfLength, 0, 0},
                 {0, -2 * kHalfBreadth, 0}, sheet);
    for (float x = -10.4F; x < kHallHalfLength; x += 5.2F) {
      build_.box({x, 0, kHallHeight - 0.35F}, {0.18F, 2 * kHalfBreadth, 0.35F}, 0.0F, steel_);
      for (const float y : {-6.0F, 0.0F, 6.0F}) {
        const Vector3f at(x + 2.6F, y, 5.5F);
        if (at.x() > kHallHalfLength - 1.0F) continue;
        build_.box(at, {1.5F, 0.4F, 0.12F}, 0.0F, steel_);
        build_.panel(at + Vector3f(-0.7F, 0.16F, -0.01F), {1.4F, 0, 0}, {0, -0.32F, 0}, lamp);
      }
    }
    for (const float y : {-3.0F, 3.0F}) {
      build_.roller({-kHallHalfLength, y, 5.9F}, {kHallHalfLength, y, 5.9F}, 0.16F, 12, steel_,
                    steel_);
    }
  }

  void pillar(const Vector3f& foot) {
    build_.column(foot, 0.26F, kHallHeight, 16, concrete_);
    build_.column(foot, 0.265F, 1.1F, 16, random_.chance(0.5) ? paint_ : steel_, 0.265F);
    if (random_.chance(0.6)) {
      const Eigen::Vector2f size(0.36F, 0.36F);
      const float side = foot.y() > 0.0F ? -1.0F : 1.0F;
      build_.panel(foot + Vector3f(side * 0.18F, side * 0.275F, 1.7F), {-side * size.x(), 0, 0},
                   {0, 0, size.y()}, palette_.sign(size, random_.chance(0.4)));
    }
  }

  void carton(const Vector3f& foot, const Vector3f& size, float yaw) {
    build_.box(foot, size, yaw, palette_.cardboard({size.x(), size.z()}));
  }

  void rack(const Vector3f& foot, float yaw) {
    constexpr float kRackLength = 3.4F;
    for (const float x : {-kRackLength / 2, 0.0F, kRackLength / 2}) {
      for (const float y : {-0.4F, 0.4F}) {
        build_.box(foot + Vector3f(x, y, 0), {0.08F, 0.08F, 3.2F}, yaw, steel_);
      }
    }
    for (const float z : {0.12F, 1.1F, 2.1F}) {
      build_.box(foot + Vector3f(0, 0, z), {kRackLength, 0.86F, 0.06F}, yaw, wood_);
      for (float x = -1.5F; x < 1.5F;) {
        const float width = random_.uniform_f(0.35, 0.7);
        if (random_.chance(0.75) && x + width < 1.65F) {
          const float aside = random_.uniform_f(-0.1, 0.1);
          const Vector3f size{width - 0.04F, random_.uniform_f(0.4, 0.65),
                              random_.uniform_f(0.3, 0.75)};
          carton(foot + Vector3f(x + width / 2, aside, z + 0.06F), size,
                 random_.uniform_f(-0.06, 0.06));
        }
        x += width;
      }
    }
  }

  // A pallet with boxes.
  void stack(const Vector3f& foot) {
    const float yaw = random_.uniform_f(-0.4, 0.4);
    build_.box(foot + Vector3f(0, 0, 0.02F), {1.0F, 0.8F, 0.12F}, yaw, wood_);
    float z = 0.14F;
    for (int i = random_.index(3); i >= 0; --i) {
      const float height = random_.uniform_f(0.3, 0.6);
      const Vector3f size{random_.uniform_f(0.6, 0.95), random_.uniform_f(0.5, 0.75), height};
      carton(foot + Vector3f(0, 0, z), size, yaw + random_.uniform_f(-0.15, 0.15));
      z += height;
    }
  }

  void table(const Vector3f& foot, float yaw) {
    build_.box(foot + Vector3f(0, 0, 0.76F), {1.8F, 0.8F, 0.05F}, yaw, wood_);
    for (const float x : {-0.8F, 0.8F}) {
      build_.box(foot + Vector3f(x, 0, 0), {0.07F, 0.6F, 0.76F}, yaw, steel_);
    }
    carton(foot + Vector3f(-0.4F, 0.0F, 0.81F), {0.4F, 0.3F, 0.25F}, yaw + 0.3F);
    build_.column(foot + Vector3f(0.4F, 0.1F, 0.81F), 0.09F, 0.3F, 10, paint_);
  }

  SceneBuilder build_;
  Random& random_;
  Palette palette_;
  int steel_;
  int paint_;
  int wood_;
  int concrete_;
  int window_ = 0;
};

}  // namespace

Scene make_hall(std::uint64_t seed) {
  Scene scene;
  HallBuilder(scene, seed ^ 0x4a11U).build();
  scene.bounced_light = 0.6F;
  scene.light_spacing_m = 0.22F;
  scene.exposure_gain = 300.0F;
  scene.walk.corners = {{-8.3, -4.4}, {8.3, -4.4}, {8.3, 4.4}, {-8.3, 4.4}};
  scene.walk.corner_m = 2.2;
  scene.walk.speed_m_s = 1.1;
  scene.walk.look_yaw_deg = 45.0;
  return scene;
}

}  // namespace sparsight::simulated
