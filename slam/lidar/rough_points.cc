#include "slam/lidar/rough_points.h"

#include <cmath>
#include <cstddef>

namespace sparsight {
namespace {

constexpr float kRoughWeight = 0.2F;
// A plane of returns that scatter as a LiDAR does, two or three centimetres, and not of a hedge.
constexpr float kSmoothM = 0.05F;    // metres, rms
constexpr float kOnPlaneRms = 2.0F;  // of its thickness
constexpr float kScatterM = 0.02F;   // metres

bool lies_on(const SweepSurface& surface, const Eigen::Vector3f& p_lidar) {
  const SweepSurface::Plane* plane = surface.at(p_lidar);
  return plane != nullptr && plane->thickness_m < kSmoothM &&
         std::abs(plane->normal.dot(p_lidar - plane->centre)) <
             kOnPlaneRms * plane->thickness_m + kScatterM;
}

}  // namespace

void weigh_down_rough(std::vector<SelectedPoint>& points, const SweepSurface& surface,
                      const Eigen::Isometry3d& T_camera_lidar) {
  const Eigen::Isometry3f T_lidar_camera = T_camera_lidar.inverse().cast<float>();
  for (SelectedPoint& point : points) {
    point.rough = !lies_on(surface, T_lidar_camera * point.p_camera);
    if (point.rough) point.weight *= kRoughWeight;
  }
}

void count_rough_fully(const std::vector<SelectedPoint>& points, std::vector<PatchSet>& patches) {
  for (std::size_t point = 0; point < points.size(); ++point) {
    if (!points[point].rough) continue;
    for (PatchSet& level : patches) {
      for (std::size_t pixel = 0; pixel < kPatternSize; ++pixel) {
        level.weight[point * kPatternSize + pixel] /= kRoughWeight;
      }
    }
  }
}

}  // namespace sparsight
