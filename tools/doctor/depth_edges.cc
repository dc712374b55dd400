#include "tools/doctor/depth_edges.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace sparsight {
namespace {

bool is_near_exposure(const LidarReturn& r, const DepthEdgeConfig& config) {
  return std::abs(r.from_exposure_ns) <= config.most_from_exposure.count();
}

// Of the near return towards its neighbour behind; `before` is the neighbour on the other side. A
// wall seen at a grazing angle recedes as much on both.
void add_edge(const LidarReturn* before, const LidarReturn& near, const LidarReturn& far,
              const RigCalibration& rig, const DepthEdgeConfig& config,
              std::vector<DepthEdge>& edges) {
  const Eigen::Vector3d p = near.p_lidar.cast<double>();
  const Eigen::Vector3d q = far.p_lidar.cast<double>();
  const double range = p.norm();
  const double slope =
      before == nullptr ? 0.0 : std::abs(range - static_cast<double>(before->p_lidar.norm()));
  const double jump = q.norm() - range - slope;
  if (jump < config.least_jump_m || jump < config.least_jump * range) return;
  const Eigen::Vector3d between = p / range + q.normalized();
  edges.push_back({.p_camera = rig.T_camera_lidar * (range * between.normalized()),
                   .weight = std::sqrt(std::min(jump, config.most_jump_m))});
}

}  // namespace

std::vector<DepthEdge> depth_edges(const Sweep& sweep, const RigCalibration& rig,
                                   const DepthEdgeConfig& config) {
  constexpr double kDegree = M_PI / 180.0;
  const double least_cosine = std::cos(config.most_gap_deg * kDegree);
  const auto& returns = sweep.returns;
  const auto are_neighbours = [&](std::size_t i, std::size_t k) {
    const LidarReturn& a = returns[i];
    const LidarReturn& b = returns[k];
    const float cosine = a.p_lidar.dot(b.p_lidar) / (a.p_lidar.norm() * b.p_lidar.norm());
    return a.ring == b.ring && static_cast<double>(cosine) > least_cosine;
  };
  std::vector<DepthEdge> edges;
  for (std::size_t i = 1; i < returns.size(); ++i) {
    if (!is_near_exposure(returns[i - 1], config) || !is_near_exposure(returns[i], config) ||
        !are_neighbours(i - 1, i)) {
      continue;
    }
    if (returns[i - 1].p_lidar.squaredNorm() < returns[i].p_lidar.squaredNorm()) {
      const bool has_before = i >= 2 && are_neighbours(i - 2, i - 1);
      add_edge(has_before ? &returns[i - 2] : nullptr, returns[i - 1], returns[i], rig, config,
               edges);
    } else {
      const bool has_before = i + 1 < returns.size() && are_neighbours(i, i + 1);
      add_edge(has_before ? &returns[i + 1] : nullptr, returns[i], returns[i - 1], rig, config,
               edges);
    }
  }
  return edges;
}

}  // namespace sparsight
