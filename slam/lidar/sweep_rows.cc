#include "slam/lidar/sweep_rows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "slam/geometry/arctangent.h"

namespace sparsight {
namespace {

constexpr double kRowRad = 1.6 * M_PI / 180.0;
constexpr int kEnoughOfARing = 50;
constexpr double kBeyondRad = 1.5 * M_PI / 180.0;

}  // namespace

float elevation_rad(const Eigen::Vector3f& p_lidar) {
  return arctangent(p_lidar.z(), p_lidar.head<2>().norm());
}

SweepRows::SweepRows(std::span<const SweepPoint> points) {
  struct Ring {
    double elevation = 0.0;
    int returns = 0;
  };
  std::vector<Ring> rings;
  for (const SweepPoint& point : points) {
    if (point.ring >= rings.size()) rings.resize(point.ring + 1U);
    Ring& ring = rings[point.ring];
    // The first of a ring tell its elevation as well as all do.
    if (ring.returns == kEnoughOfARing) continue;
    ring.elevation += elevation_rad(point.p_lidar);
    ++ring.returns;
  }
  std::vector<std::size_t> upwards;
  for (std::size_t ring = 0; ring < rings.size(); ++ring) {
    if (rings[ring].returns == 0) continue;
    rings[ring].elevation /= rings[ring].returns;
    upwards.push_back(ring);
  }
  std::sort(upwards.begin(), upwards.end(),
            [&](std::size_t a, std::size_t b) { return rings[a].elevation < rings[b].elevation; });

  of_ring_.assign(rings.size(), -1);
  double lowest = 0.0;
  int members = 0;
  for (const std::size_t ring : upwards) {
    const double elevation = rings[ring].elevation;
    if (elevation_rad_.empty() || elevation - lowest > kRowRad) {
      lowest = elevation;
      members = 0;
      elevation_rad_.push_back(0.0);
    }
    ++members;
    elevation_rad_.back() += (elevation - elevation_rad_.back()) / members;
    of_ring_[ring] = static_cast<int>(elevation_rad_.size()) - 1;
  }
}

int SweepRows::at(double elevation) const {
  const auto begin = elevation_rad_.begin();
  const auto end = elevation_rad_.end();
  auto nearest = std::lower_bound(begin, end, elevation);
  if (nearest == end || (nearest != begin && elevation - *(nearest - 1) < *nearest - elevation)) {
    if (nearest == begin) return -1;
    --nearest;
  }
  const double beyond =
      std::max(elevation_rad_.front() - elevation, elevation - elevation_rad_.back());
  return beyond <= kBeyondRad ? static_cast<int>(nearest - begin) : -1;
}

}  // namespace sparsight
