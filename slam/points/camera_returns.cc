#include "slam/points/camera_returns.h"

#include "slam/points/sweep_motion.h"

namespace sparsight {
MotionAround constant_motion(const Vector6d& twist) {
  return [twist](double seconds) { return exp_se3(twist * seconds); };
}

std::vector<CameraReturn> returns_in_image(const Sweep& sweep, const CameraModel& camera,
                                           const Eigen::Isometry3d& T_camera_lidar,
                                           const MotionAround& motion) {
  const SweepMotion in_camera(firing_span(sweep), [&](double seconds) -> Eigen::Isometry3d {
    return motion(seconds) * T_camera_lidar;
  });
  std::vector<CameraReturn> result;
  result.reserve(sweep.returns.size() / 2);
  for (const LidarReturn& r : sweep.returns) {
    const Eigen::Vector3f p = in_camera.moved(r);
    Eigen::Vector2d pixel;
    if (!camera.project(p.cast<double>(), pixel) || !camera.contains(pixel, 0.0)) continue;
    result.push_back(
        {.p_camera = p, .pixel = pixel.cast<float>(), .intensity = r.intensity, .ring = r.ring});
  }
  return result;
}

}  // namespace sparsight
