#include "drivers/simulated/scene_builder.h"

#include <cmath>

namespace sparsight::simulated {
namespace {

using Eigen::Vector3f;

Vector3f around(float angle) { return {std::cos(angle), std::sin(angle), 0.0F}; }

}  // namespace

void SceneBuilder::quad(const std::array<Vector3f, 4>& corners, int material) {
  Panel panel;
  panel.corners = corners;
  panel.material = material;
  panel.offset = {random_.uniform_f(0.0, 8.0), random_.uniform_f(0.0, 8.0)};
  scene_.panels.push_back(panel);
}

void SceneBuilder::panel(const Vector3f& lower_left, const Vector3f& right, const Vector3f& up,
                         int material) {
  quad({lower_left, lower_left + right, lower_left + right + up, lower_left + up}, material);
}

void SceneBuilder::box(const Vector3f& foot, const Vector3f& size, float yaw, int sides, int top) {
  const Vector3f x = size.x() * around(yaw);
  const Vector3f y = size.y() * Vector3f(-std::sin(yaw), std::cos(yaw), 0.0F);
  const Vector3f z(0.0F, 0.0F, size.z());
  const Vector3f low = foot - 0.5F * x - 0.5F * y;
  panel(low, x, z, sides);
  panel(low + x, y, z, sides);
  panel(low + x + y, -x, z, sides);
  panel(low + y, -y, z, sides);
  panel(low + z, x, y, top);
  if (foot.z() > 0.01F) panel(low + y, x, -y, sides);
}

void SceneBuilder::column(const Vector3f& foot, float radius, float height, int faces, int material,
                          float top_radius) {
  if (top_radius < 0.0F) top_radius = radius;
  const float step = 2.0F * static_cast<float>(M_PI) / static_cast<float>(faces);
  const Vector3f up(0.0F, 0.0F, height);
  const Eigen::Vector2f offset{random_.uniform_f(0.0, 8.0), random_.uniform_f(0.0, 8.0)};
  for (int i = 0; i < faces; ++i) {
    const Vector3f a = around(step * static_cast<float>(i));
    const Vector3f b = around(step * static_cast<float>(i + 1));
    quad({foot + radius * a, foot + radius * b, foot + top_radius * b + up,
          foot + top_radius * a + up},
         material);
    Panel& made = scene_.panels.back();
    made.round = true;
    made.left_normal = a;
    made.right_normal = b;
    made.offset = offset + Eigen::Vector2f(static_cast<float>(i) * radius * step, 0.0F);
  }
  if (top_radius <= 0.0F) return;
  for (int i = 0; i < faces; i += 2) {  // the lid, as slices of two sides
    const auto at = [&](int k) -> Vector3f {
      return foot + up + top_radius * around(step * static_cast<float>(k));
    };
    quad({foot + up, at(i), at(i + 1), at(i + 2)}, material);
  }
}

void SceneBuilder::roller(const Vector3f& from, const Vector3f& to, float radius, int faces,
                          int rim, int side) {
  const Vector3f axis = (to - from).normalized();
  const Vector3f up(0.0F, 0.0F, 1.0F);
  const Vector3f across = up.cross(axis).normalized();
  const float step = 2.0F * static_cast<float>(M_PI) / static_cast<float>(faces);
  const auto spoke = [&](int i) -> Vector3f {
    const float angle = step * static_cast<float>(i);
    return radius * (std::cos(angle) * across + std::sin(angle) * up);
  };
  for (int i = 0; i < faces; ++i) {
    quad({from + spoke(i), from + spoke(i + 1), to + spoke(i + 1), to + spoke(i)}, rim);
  }
  for (int i = 0; i < faces; i += 2) {
    quad({to, to + spoke(i), to + spoke(i + 1), to + spoke(i + 2)}, side);
    quad({from, from + spoke(i + 2), from + spoke(i + 1), from + spoke(i)}, side);
  }
}

void SceneBuilder::foliage(const Vector3f& middle, const Vector3f& radii, int leaves, float leaf_m,
                           int material) {
  for (int i = 0; i < leaves; ++i) {
    Vector3f d{static_cast<float>(random_.gaussian()), static_cast<float>(random_.gaussian()),
               static_cast<float>(random_.gaussian())};
    d.normalize();
    const float out = std::pow(random_.uniform_f(0.08, 1.0), 0.45F);
    const Vector3f at = middle + out * d.cwiseProduct(radii);
    // Leaves face outwards more than not.
    Vector3f normal = d + 0.8F * Vector3f{random_.uniform_f(-1, 1), random_.uniform_f(-1, 1),
                                          random_.uniform_f(-0.6, 1)};
    normal.normalize();
    const Vector3f right = normal.cross(Vector3f(0.31F, -0.22F, 0.92F)).normalized() * 1.4F *
                           leaf_m * random_.uniform_f(0.6, 1.2);
    const Vector3f up = normal.cross(right) * random_.uniform_f(0.5, 0.9);
    // Pointed at both ends.
    quad({at - 0.5F * right, at - 0.35F * up, at + 0.5F * right, at + 0.65F * up}, material);
  }
}

}  // namespace sparsight::simulated
