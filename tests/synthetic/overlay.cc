#include "tests/synthetic/overlay.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/synthetic/lens.h"

namespace sparsight::synthetic {
namespace {

cv::Vec3b depth_color(double depth_m) {
  const double share = std::clamp(std::log(depth_m) / std::log(80.0), 0.0, 1.0);
  const auto level = [](double x) {
    return static_cast<std::uint8_t>(255.0 * std::clamp(x, 0.0, 1.0));
  };
  return {level(2.0 * share - 0.5), level(1.0 - std::abs(2.0 * share - 1.0)),
          level(1.5 - 2.0 * share)};
}

}  // namespace

void write_overlay(const Scene& scene, std::size_t frame, const std::filesystem::path& file) {
  const GreyImage grey = scene.image(frame);
  cv::Mat3b picture(grey.height, grey.width);
  for (int v = 0; v < grey.height; ++v) {
    for (int u = 0; u < grey.width; ++u) picture(v, u) = cv::Vec3b::all(grey.at(u, v));
  }
  const double exposure = scene.exposure_s(frame);
  const Eigen::Isometry3d T_camera_world = scene.T_world_camera(exposure).inverse();
  for (const LidarReturn& r : scene.sweep(frame).returns) {
    const Eigen::Isometry3d T_world_lidar =
        scene.T_world_lidar(exposure + r.from_exposure_ns / 1e9);
    const Eigen::Vector3d p_camera = T_camera_world * T_world_lidar * r.p_lidar.cast<double>();
    const auto pixel = project(scene.rig.camera, p_camera);
    if (!pixel) continue;
    const int u = static_cast<int>(std::lround(pixel->x()));
    const int v = static_cast<int>(std::lround(pixel->y()));
    if (u < 0 || v < 0 || u >= grey.width || v >= grey.height) continue;
    picture(v, u) = depth_color(p_camera.z());
  }
  cv::imwrite(file.string(), picture);
}

}  // namespace sparsight::synthetic
