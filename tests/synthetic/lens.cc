#include "tests/synthetic/lens.h"

namespace sparsight::synthetic {
namespace {

Eigen::Vector2d distort(const CameraIntrinsics& c, const Eigen::Vector2d& ideal) {
  const double x = ideal.x();
  const double y = ideal.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  return {x * radial + 2.0 * c.p1 * x * y + c.p2 * (r2 + 2.0 * x * x),
          y * radial + c.p1 * (r2 + 2.0 * y * y) + 2.0 * c.p2 * x * y};
}

}  // namespace

Eigen::Vector3d pixel_direction(const CameraIntrinsics& camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d seen((pixel.x() - camera.cx) / camera.fx,
                             (pixel.y() - camera.cy) / camera.fy);
  Eigen::Vector2d ideal = seen;
  if (camera.distorted()) {
    // Fixed point: converges while the distortion bends less than the image is wide.
    for (int i = 0; i < 50; ++i) ideal += seen - distort(camera, ideal);
  }
  return Eigen::Vector3d(ideal.x(), ideal.y(), 1.0).normalized();
}

std::optional<Eigen::Vector2d> project(const CameraIntrinsics& camera,
                                       const Eigen::Vector3d& p_camera) {
  if (p_camera.z() <= 0.0) return std::nullopt;
  const Eigen::Vector2d ideal = p_camera.head<2>() / p_camera.z();
  const Eigen::Vector2d seen = camera.distorted() ? distort(camera, ideal) : ideal;
  return Eigen::Vector2d(camera.fx * seen.x() + camera.cx, camera.fy * seen.y() + camera.cy);
}

}  // namespace sparsight::synthetic
