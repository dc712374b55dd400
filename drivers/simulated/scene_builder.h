#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "drivers/simulated/random.h"
#include "drivers/simulated/scene.h"

namespace sparsight::simulated {

// Puts surfaces into a scene. Bodies stand on their foot; lengths in metres.
class SceneBuilder {
 public:
  explicit SceneBuilder(Scene& scene, std::uint64_t seed) : scene_(scene), random_(seed, 0x5ce0e) {}

  // A rectangle seen from its front: `right` and `up` are its edges.
  void panel(const Eigen::Vector3f& lower_left, const Eigen::Vector3f& right,
             const Eigen::Vector3f& up, int material);
  void quad(const std::array<Eigen::Vector3f, 4>& corners, int material);

  // A box around the middle of its foot, turned by `yaw`; `size` is length (along yaw), width,
  // height.
  void box(const Eigen::Vector3f& foot, const Eigen::Vector3f& size, float yaw, int sides, int top);
  void box(const Eigen::Vector3f& foot, const Eigen::Vector3f& size, float yaw, int material) {
    box(foot, size, yaw, material, material);
  }
  // Round: `faces` flat sides, lit as one curve.
  void column(const Eigen::Vector3f& foot, float radius, float height, int faces, int material,
              float top_radius = -1.0F);
  // A wheel or roller: a lying column, from `from` to `to`.
  void roller(const Eigen::Vector3f& from, const Eigen::Vector3f& to, float radius, int faces,
              int rim, int side);
  // Leaves scattered in an ellipsoid, denser outside.
  void foliage(const Eigen::Vector3f& middle, const Eigen::Vector3f& radii, int leaves,
               float leaf_m, int material);

  Random& random() { return random_; }

 private:
  Scene& scene_;
  Random random_;
};

}  // namespace sparsight::simulated
