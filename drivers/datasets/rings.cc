#include "drivers/datasets/rings.h"

#include <cmath>
#include <numbers>

namespace sparsight {

std::size_t assign_rings(std::vector<LidarReturn>& returns) {
  if (returns.empty()) return 0;
  std::uint16_t ring = 0;
  double last = -1.0;
  for (LidarReturn& point : returns) {
    double azimuth = std::atan2(point.p_lidar.y(), point.p_lidar.x());
    if (azimuth < 0) azimuth += 2 * std::numbers::pi;
    if (azimuth - last < -std::numbers::pi) ++ring;
    point.ring = ring;
    last = azimuth;
  }
  return ring + std::size_t{1};
}

void keep_rings(std::vector<LidarReturn>& returns, std::size_t ring_count, std::size_t wanted) {
  if (ring_count <= wanted) return;
  std::vector<bool> kept(ring_count, false);
  for (std::size_t k = 0; k < wanted; ++k) kept[k * ring_count / wanted] = true;
  std::erase_if(returns, [&](const LidarReturn& point) { return !kept[point.ring]; });
}

}  // namespace sparsight
