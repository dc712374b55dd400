#include "slam/points/visibility.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace sparsight {
namespace {

// A jump is a change of range beyond this share of the nearer range and beyond sensor noise. Walls
// seen at 5 degrees change by 3 % between neighbouring firings of an HDL-64, 8 % of a VLP-16.
constexpr float kJumpShare = 0.1F;
constexpr float kRangeNoise = 0.1F;  // metres
// Farther apart than this, two firings of a ring are not neighbours: something did not return.
constexpr float kNeighborCosine = 0.99985F;  // 1 degree

constexpr double kCellRad = 0.5 * M_PI / 180.0;  // hidden within one to two cells
constexpr float kHiddenShare = 0.85F;            // nearer than this share of the depth
// And nearer by this much, 1/m: within two cells, inverse depth changes as much on the ground 1.2 m
// below the camera, at any distance. Less would shift by less than half a cell between a camera and
// a LiDAR that stand 0.3 m apart: that is left to the depth edges.
constexpr float kHiddenInverseDepth = 2.0F * static_cast<float>(kCellRad) / 1.2F;

bool jump_between(const CameraReturn& a, float range_a, const CameraReturn& b, float range_b) {
  const float nearer = std::min(range_a, range_b);
  if (a.p_camera.dot(b.p_camera) < kNeighborCosine * range_a * range_b) return false;
  return std::abs(range_a - range_b) > std::max(kRangeNoise, kJumpShare * nearer);
}

}  // namespace

std::vector<bool> on_depth_edge(const std::vector<CameraReturn>& returns) {
  std::vector<bool> edge(returns.size(), false);
  float range = 0.0F;
  for (std::size_t i = 0; i < returns.size(); ++i) {
    const float last_range = std::exchange(range, returns[i].p_camera.norm());
    if (i == 0 || returns[i - 1].ring != returns[i].ring) continue;
    if (!jump_between(returns[i - 1], last_range, returns[i], range)) continue;
    edge[i - 1] = edge[i] = true;
  }
  return edge;
}

std::vector<bool> hidden_from_camera(const std::vector<CameraReturn>& returns,
                                     const CameraModel& camera) {
  const CameraIntrinsics& c = camera.intrinsics();
  const auto cell_px = static_cast<float>(std::max(1.0, c.fx * kCellRad));
  const int columns = static_cast<int>(static_cast<float>(c.width) / cell_px) + 3;
  const int rows = static_cast<int>(static_cast<float>(c.height) / cell_px) + 3;
  const auto cell_of = [&](const CameraReturn& r) {
    const int column = 1 + static_cast<int>(r.pixel.x() / cell_px);
    const int row = 1 + static_cast<int>(r.pixel.y() / cell_px);
    return row * columns + column;
  };

  std::vector<float> nearest(static_cast<std::size_t>(rows * columns), 1e9F);
  for (const CameraReturn& r : returns) {
    float& depth = nearest[static_cast<std::size_t>(cell_of(r))];
    depth = std::min(depth, r.p_camera.z());
  }
  std::vector<bool> hidden(returns.size(), false);
  for (std::size_t i = 0; i < returns.size(); ++i) {
    const int cell = cell_of(returns[i]);
    float depth = 1e9F;
    for (const int row : {-columns, 0, columns}) {
      for (const int column : {-1, 0, 1}) {
        depth = std::min(depth, nearest[static_cast<std::size_t>(cell + row + column)]);
      }
    }
    const float own_depth = returns[i].p_camera.z();
    hidden[i] =
        depth < kHiddenShare * own_depth && 1.0F / depth - 1.0F / own_depth > kHiddenInverseDepth;
  }
  return hidden;
}

}  // namespace sparsight
