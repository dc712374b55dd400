#include "drivers/simulated/lens.h"

namespace sparsight::simulated {
namespace {

// Brown 1971, in OpenCV's order of coefficients.
Eigen::Vector2d distorted(const CameraIntrinsics& c, const Eigen::Vector2d& p) {
  const double x = p.x();
  const double y = p.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  return {x * radial + 2.0 * c.p1 * x * y + c.p2 * (r2 + 2.0 * x * x),
          y * radial + c.p1 * (r2 + 2.0 * y * y) + 2.0 * c.p2 * x * y};
}

}  // namespace

Eigen::Vector2d project(const CameraIntrinsics& camera, const Eigen::Vector2d& on_plane) {
  const Eigen::Vector2d seen = camera.distorted() ? distorted(camera, on_plane) : on_plane;
  return {camera.fx * seen.x() + camera.cx, camera.fy * seen.y() + camera.cy};
}

Eigen::Vector2d unproject(const CameraIntrinsics& camera, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d seen((pixel.x() - camera.cx) / camera.fx,
                             (pixel.y() - camera.cy) / camera.fy);
  Eigen::Vector2d ideal = seen;
  if (!camera.distorted()) return ideal;
  // The distortion is a contraction for lenses like ours: its fixed point is found in few steps.
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector2d missing = seen - distorted(camera, ideal);
    ideal += missing;
    if (missing.squaredNorm() < 1e-22) break;
  }
  return ideal;
}

}  // namespace sparsight::simulated
