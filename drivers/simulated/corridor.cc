#include "drivers/simulated/corridor.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "drivers/simulated/palette.h"
#include "drivers/simulated/scene_builder.h"

namespace sparsight::simulated {
namespace {

using Eigen::Vector3f;

// The middle line of the loop, and the corridor around it.
constexpr float kLength = 17.6F;
constexpr float kBreadth = 13.6F;
constexpr float kWidth = 2.3F;
constexpr float kHeight = 2.75F;
const Eigen::Vector2f kDoor{0.95F, 2.08F};
const Eigen::Vector2f kWindow{2.0F, 1.4F};

// A wall seen from the corridor: `along` to the right, `into` the wall.
struct Wall {
  Vector3f corner;
  Vector3f along;
  float length;
  int material;
  bool outside;  // of the building: may have windows
  bool rail = false;

  Vector3f into() const { return Vector3f(0, 0, 1).cross(along); }
  Vector3f at(float x, float z, float depth = 0.0F) const {
    return corner + x * along + Vector3f(0, 0, z) + depth * into();
  }
  float yaw() const { return std::atan2(along.y(), along.x()); }
};

// An opening in a wall.
struct Recess {
  float from;
  float to;
  float low;
  float high;
  float depth;
  int back;
  int frame;
};

class CorridorBuilder {
 public:
  CorridorBuilder(Scene& scene, std::uint64_t seed)
      : build_(scene, seed), random_(build_.random()), palette_(scene.library, random_) {
    skirting_ = palette_.plain(0.3F, 0.03F, 0.05F);
    frame_ = palette_.plain(0.45F, 0.03F, 0.06F, 55);
    metal_ = palette_.tinted(palette_.plain(0.5F, 0.03F, 0.05F, 70), 215.0F, 0.08F);
    lamp_ = palette_.lamp(11.0F);
    radiator_ = palette_.slats(0.06F);
    wood_ = palette_.tinted(palette_.plain(0.38F, 0.05F, 0.2F, 35), 28.0F, 0.45F);
    leaf_ = palette_.leaves(0.28F);
  }

  void build() {
    const float a = kLength / 2.0F;
    const float b = kBreadth / 2.0F;
    const float w = kWidth / 2.0F;
    const int bright = palette_.tinted(palette_.plain(0.66F, 0.10F, 0.05F, 60), 46.0F, 0.2F);
    const int plain = palette_.tinted(palette_.plain(0.58F, 0.07F, 0.04F, 55), 130.0F, 0.12F);
    const int brick = palette_.bricks();
    // Outer walls as seen from inside; the block's walls as seen from around it.
    wall({{a + w, -b - w, 0}, {-1, 0, 0}, kLength + kWidth, plain, true});
    wall({{-a - w, -b - w, 0}, {0, 1, 0}, kBreadth + kWidth, bright, true, true});
    wall({{-a - w, b + w, 0}, {1, 0, 0}, kLength + kWidth, brick, true});
    wall({{a + w, b + w, 0}, {0, -1, 0}, kBreadth + kWidth, bright, true});
    wall({{-a + w, -b + w, 0}, {1, 0, 0}, kLength - kWidth, bright, false});
    wall({{a - w, -b + w, 0}, {0, 1, 0}, kBreadth - kWidth, plain, false});
    wall({{a - w, b - w, 0}, {-1, 0, 0}, kLength - kWidth, plain, false, true});
    wall({{-a + w, b - w, 0}, {0, -1, 0}, kBreadth - kWidth, brick, false});
    floors(a, b, w);
    ceiling(a, b, w);
  }

 private:
  void wall(const Wall& wall) {
    const std::vector<Recess> recesses = plan(wall);
    float from = 0.0F;
    for (const Recess& recess : recesses) {
      piece(wall, from, recess.from);
      cut(wall, recess);
      from = recess.to;
    }
    piece(wall, from, wall.length);
  }

  // Doors at even distances, as in real buildings; between them whatever hangs or stands there.
  std::vector<Recess> plan(const Wall& wall) {
    std::vector<Recess> recesses;
    const float every = wall.outside ? 3.5F : 3.2F;
    const int slots = static_cast<int>((wall.length - 1.0F) / every);
    const float margin = 0.5F * (wall.length - static_cast<float>(slots) * every);
    for (int i = 0; i < slots; ++i) {
      const float middle = margin + (static_cast<float>(i) + 0.5F) * every;
      const bool corner = wall.outside && (i == 0 || i == slots - 1);
      if (!corner && random_.chance(0.62)) {
        recesses.push_back({middle - kDoor.x() / 2, middle + kDoor.x() / 2, 0.0F, kDoor.y(), 0.12F,
                            palette_.door(kDoor), frame_});
      } else if (wall.outside && random_.chance(0.5)) {
        recesses.push_back({middle - kWindow.x() / 2, middle + kWindow.x() / 2, 0.85F,
                            0.85F + kWindow.y(), 0.22F, palette_.window(1.1F), frame_});
      } else {
        const float half = random_.uniform_f(0.5, 0.75);
        recesses.push_back({middle - half, middle + half, 0.0F, random_.uniform_f(2.0, 2.35),
                            random_.uniform_f(0.35, 0.7), wall.material, wall.material});
      }
    }
    return recesses;
  }

  void piece(const Wall& wall, float from, float to) {
    build_.panel(wall.at(from, 0), (to - from) * wall.along, {0, 0, kHeight}, wall.material);
    const Vector3f out = -0.015F * wall.into();
    build_.panel(wall.at(from, 0) + out, (to - from) * wall.along, {0, 0, 0.09F}, skirting_);
    build_.panel(wall.at(from, 0.09F) + out, (to - from) * wall.along, -out, skirting_);
    if (wall.rail) {
      build_.box(wall.at((from + to) / 2, 0.92F, -0.06F), {to - from, 0.05F, 0.09F}, wall.yaw(),
                 wood_);
    }
    if (to - from > 0.9F) furnish(wall, from, to);
  }

  void cut(const Wall& wall, const Recess& r) {
    const Vector3f right = (r.to - r.from) * wall.along;
    const Vector3f in = r.depth * wall.into();
    const Vector3f up(0, 0, r.high - r.low);
    if (r.low > 0.0F) build_.panel(wall.at(r.from, 0), right, {0, 0, r.low}, wall.material);
    build_.panel(wall.at(r.from, r.high), right, {0, 0, kHeight - r.high}, wall.material);
    build_.panel(wall.at(r.from, r.low) + in, right, up, r.back);
    build_.panel(wall.at(r.from, r.low), in, up, r.frame);
    build_.panel(wall.at(r.to, r.low) + in, -in, up, r.frame);
    build_.panel(wall.at(r.from, r.high) + in, right, -in, r.frame);
    if (r.low > 0.0F) {
      build_.panel(wall.at(r.from, r.low), right, in, r.frame);
      radiator(wall, r);
    }
    if (r.back == wall.material) furnish_niche(wall, r);
    if (r.frame == frame_) casing(wall, r);
  }

  // The frame around a door or window stands out a little.
  void casing(const Wall& wall, const Recess& r) {
    const float yaw = wall.yaw();
    const float height = r.high - r.low;
    for (const float x : {r.from - 0.035F, r.to + 0.035F}) {
      build_.box(wall.at(x, r.low, -0.01F), {0.07F, 0.04F, height + 0.07F}, yaw, frame_);
    }
    build_.box(wall.at((r.from + r.to) / 2, r.high, -0.01F), {r.to - r.from, 0.04F, 0.07F}, yaw,
               frame_);
    if (r.low > 0.0F) {
      build_.box(wall.at((r.from + r.to) / 2, r.low - 0.03F, -0.05F),
                 {r.to - r.from + 0.2F, 0.14F, 0.03F}, yaw, wood_);
    }
  }

  void radiator(const Wall& wall, const Recess& r) {
    build_.box(wall.at((r.from + r.to) / 2, 0.15F, -0.08F), {1.5F, 0.1F, 0.55F}, wall.yaw(),
               radiator_, metal_);
  }

  void hang_poster(const Wall& wall, float middle) {
    const Eigen::Vector2f size{random_.uniform_f(0.45, 0.85), random_.uniform_f(0.6, 1.0)};
    const float low = random_.uniform_f(1.15, 1.35);
    build_.panel(wall.at(middle - size.x() / 2, low, -0.012F), size.x() * wall.along,
                 {0, 0, size.y()}, palette_.poster(size));
    if (random_.chance(0.5)) return;
    build_.box(wall.at(middle, low - 0.02F, 0.0F), {size.x() + 0.04F, 0.022F, size.y() + 0.04F},
               wall.yaw(), wood_);
  }

  void furnish(const Wall& wall, float from, float to) {
    const float middle = (from + to) / 2 + random_.uniform_f(-0.2, 0.2);
    const float yaw = wall.yaw();
    if (random_.chance(0.62)) hang_poster(wall, middle);
    if (random_.chance(0.3)) {  // switch
      build_.box(wall.at(from + 0.18F, 1.05F, -0.005F), {0.08F, 0.02F, 0.08F}, yaw, metal_);
    }
    if (random_.chance(0.15)) {  // extinguisher
      build_.column(wall.at(to - 0.3F, 0.55F, -0.1F), 0.075F, 0.5F, 10,
                    palette_.tinted(palette_.plain(0.22F, 0.02F, 0.05F, 50), 2.0F, 1.1F));
      const Eigen::Vector2f size(0.2F, 0.2F);
      build_.panel(wall.at(to - 0.4F, 1.6F, -0.01F), size.x() * wall.along, {0, 0, size.y()},
                   palette_.sign(size, true));
    }
    if (random_.chance(0.12)) {  // bin
      build_.column(wall.at(from + 0.3F, 0.0F, -0.2F), 0.14F, 0.6F, 10, metal_, 0.16F);
    }
    if (random_.chance(0.25)) {  // sign that stands out from the wall, under the ceiling
      const Eigen::Vector2f size(0.36F, 0.2F);
      build_.box(wall.at(to - 0.1F, 2.3F, -0.2F), {size.x(), 0.02F, size.y()},
                 yaw + static_cast<float>(M_PI) / 2, palette_.sign(size, false));
    }
  }

  void furnish_niche(const Wall& wall, const Recess& r) {
    const float yaw = wall.yaw();
    const float middle = (r.from + r.to) / 2;
    switch (random_.index(4)) {
      case 0:  // bench
        build_.box(wall.at(middle, 0.40F, r.depth / 2),
                   {r.to - r.from - 0.06F, r.depth - 0.05F, 0.06F}, yaw, wood_);
        build_.box(wall.at(r.from + 0.15F, 0.0F, r.depth / 2), {0.06F, 0.25F, 0.40F}, yaw, metal_);
        build_.box(wall.at(r.to - 0.15F, 0.0F, r.depth / 2), {0.06F, 0.25F, 0.40F}, yaw, metal_);
        break;
      case 1:  // plant
        build_.column(wall.at(middle, 0.0F, r.depth / 2), 0.15F, 0.4F, 10,
                      palette_.tinted(palette_.plain(0.4F, 0.04F, 0.08F), 16.0F, 0.55F), 0.19F);
        build_.foliage(wall.at(middle, 0.9F, r.depth / 2), {0.28F, 0.28F, 0.45F}, 160, 0.11F,
                       leaf_);
        break;
      case 2: {  // boxes
        const Eigen::Vector2f size(0.5F, 0.4F);
        build_.box(wall.at(middle - 0.1F, 0.0F, r.depth / 2), {0.5F, 0.32F, 0.4F}, yaw + 0.1F,
                   palette_.cardboard(size));
        build_.box(wall.at(middle - 0.02F, 0.4F, r.depth / 2), {0.42F, 0.3F, 0.3F}, yaw - 0.15F,
                   palette_.cardboard(size));
        break;
      }
      default: {  // cupboard
        const Eigen::Vector2f size(r.to - r.from - 0.2F, 1.6F);
        build_.box(wall.at(middle, 0.0F, r.depth / 2), {size.x(), r.depth - 0.04F, size.y()}, yaw,
                   palette_.door(size), wood_);
        break;
      }
    }
  }

  void floors(float a, float b, float w) {
    const int tiles = palette_.floor_tiles(0.45F, 0.5F, 0.26F);
    const int dark = palette_.floor_tiles(0.3F, 0.36F, 0.2F);
    const int boards = palette_.boards();
    const float deep = 0.8F;  // niches have a floor, too
    const Vector3f long_way(kLength - kWidth, 0, 0);
    const Vector3f wide(0, kWidth + 2 * deep, 0);
    build_.panel({-a + w, -b - w - deep, 0}, long_way, wide, tiles);
    build_.panel({-a + w, b - w - deep, 0}, long_way, wide, tiles);
    const Vector3f across(kWidth + 2 * deep, 0, 0);
    const Vector3f deep_way(0, kBreadth + kWidth + 2 * deep, 0);
    build_.panel({-a - w - deep, -b - w - deep, 0}, {kWidth + deep, 0, 0}, deep_way, boards);
    build_.panel({a - w, -b - w - deep, 0}, {kWidth + deep, 0, 0}, deep_way, dark);
    build_.panel({-a + w, -b + w, 0.0F}, {deep, 0, 0}, {0, kBreadth - kWidth, 0}, boards);
    build_.panel({a - w - deep, -b + w, 0.0F}, {deep, 0, 0}, {0, kBreadth - kWidth, 0}, dark);
  }

  void ceiling(float a, float b, float w) {
    const int panels = palette_.ceiling_panels();
    const int beam = palette_.plain(0.5F, 0.06F, 0.05F, 55);
    build_.panel({-a - w, b + w, kHeight}, {kLength + kWidth, 0, 0}, {0, -kBreadth - kWidth, 0},
                 panels);
    const auto lights = [&](const Vector3f& from, const Vector3f& to) {
      const Vector3f way = to - from;
      const int count = static_cast<int>(way.norm() / 2.6F);
      const float yaw = std::atan2(way.y(), way.x());
      for (int i = 0; i < count; ++i) {
        const Vector3f at = from + way * (static_cast<float>(i) + 0.5F) / static_cast<float>(count);
        const Vector3f x = Vector3f(std::cos(yaw), std::sin(yaw), 0);
        const Vector3f y(-x.y(), x.x(), 0);
        const Vector3f low = at + Vector3f(0, 0, kHeight - 0.06F);
        build_.box(low, {1.24F, 0.32F, 0.06F}, yaw, metal_);
        if (random_.chance(0.93)) {
          build_.panel(low - 0.58F * x + 0.13F * y - Vector3f(0, 0, 0.005F), 1.16F * x, -0.26F * y,
                       lamp_);
        }
        if (i % 3 == 1) {
          const Vector3f side = at + 1.3F * x;
          build_.box(side + Vector3f(0, 0, kHeight - 0.22F), {0.25F, kWidth, 0.22F}, yaw, beam);
        }
        if (random_.chance(0.4)) {
          build_.column(at + 0.9F * x + 0.4F * y + Vector3f(0, 0, kHeight - 0.05F), 0.06F, 0.05F, 8,
                        metal_);
        }
      }
    };
    lights({-a, -b, 0}, {a, -b, 0});
    lights({a, -b, 0}, {a, b, 0});
    lights({a, b, 0}, {-a, b, 0});
    lights({-a, b, 0}, {-a, -b, 0});
  }

  SceneBuilder build_;
  Random& random_;
  Palette palette_;
  int skirting_;
  int frame_;
  int metal_;
  int lamp_;
  int radiator_;
  int wood_;
  int leaf_;
};

}  // namespace

Scene make_corridor(std::uint64_t seed) {
  Scene scene;
  CorridorBuilder(scene, seed ^ 0xc0441d04U).build();
  scene.bounced_light = 1.0F;
  scene.light_spacing_m = 0.18F;
  scene.exposure_gain = 260.0F;
  const double a = kLength / 2.0;
  const double b = kBreadth / 2.0;
  scene.walk.corners = {{-a, -b}, {a, -b}, {a, b}, {-a, b}};
  scene.walk.corner_m = 1.0;
  // A lap of 60 m in 60 s, one of which is rest and two are gathering speed.
  scene.walk.speed_m_s = 60.5 / 58.0;
  return scene;
}

}  // namespace sparsight::simulated
