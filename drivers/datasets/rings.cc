#include "drivers/datasets/rings.h"

#include <algorithm>
#include <numeric>

#include "drivers/datasets/rings_by_elevation.h"
#include "drivers/datasets/rings_by_wrap.h"
#include "drivers/datasets/scan_angles.h"

namespace sparsight {
namespace {

// Ring after ring, and along each ring by azimuth from the widest gap on.
void sort_along_rings(std::vector<LidarReturn>& returns, const ScanAngles& angles) {
  const float seam = widest_gap(angles.azimuth).center;
  std::vector<std::size_t> order(returns.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (returns[a].ring != returns[b].ring) return returns[a].ring < returns[b].ring;
    return wrapped_360(angles.azimuth[a] - seam) < wrapped_360(angles.azimuth[b] - seam);
  });
  std::vector<LidarReturn> sorted;
  sorted.reserve(returns.size());
  for (const std::size_t i : order) sorted.push_back(returns[i]);
  returns = std::move(sorted);
}

}  // namespace

std::size_t assign_rings(std::vector<LidarReturn>& returns) {
  if (returns.empty()) return 0;
  const ScanAngles angles = scan_angles(returns);
  const auto stored = rings_by_wrap(angles);
  const std::vector<std::uint16_t> ring = stored ? *stored : rings_by_elevation(angles);
  for (std::size_t i = 0; i < returns.size(); ++i) returns[i].ring = ring[i];
  const auto by_ring = [](const LidarReturn& a, const LidarReturn& b) { return a.ring < b.ring; };
  if (!stored) {
    sort_along_rings(returns, angles);
  } else if (!std::is_sorted(returns.begin(), returns.end(), by_ring)) {
    // A return that jitter put across the seam goes to its ring.
    std::stable_sort(returns.begin(), returns.end(), by_ring);
  }
  return returns.back().ring + std::size_t{1};
}

void keep_rings(std::vector<LidarReturn>& returns, std::size_t ring_count, std::size_t wanted) {
  if (ring_count <= wanted) return;
  std::vector<bool> kept(ring_count, false);
  for (std::size_t k = 0; k < wanted; ++k) kept[k * ring_count / wanted] = true;
  std::erase_if(returns, [&](const LidarReturn& point) { return !kept[point.ring]; });
}

}  // namespace sparsight
