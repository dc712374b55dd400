#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "slam/geometry/se3.h"

namespace sparsight {

// What is known of one pose relative to another.
struct PoseEdge {
  std::size_t from = 0;  // nodes, by their place in PoseGraph
  std::size_t to = 0;
  Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity();
  Matrix6d information = Matrix6d::Identity();  // left perturbation of T_from_to, as in eq. (2)
  // A place recognised, which may be a mistake; the other edges come from odometry.
  bool loop = false;
};

// Poses and what is known between them (Sec. IV-E).
struct PoseGraph {
  std::vector<Eigen::Isometry3d> T_world_node;
  std::vector<PoseEdge> edges;
  // Nodes that do not move. A part of the graph without any is held at its first node.
  std::vector<std::size_t> held;
};

}  // namespace sparsight
