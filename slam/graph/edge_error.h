#pragma once

#include "slam/graph/pose_graph.h"

namespace sparsight {

// What an edge says against the poses of its two nodes: log(T_from_to_estimated T_from_to^-1), the
// left perturbation of the measurement that would make it true.
Vector6d edge_error(const Eigen::Isometry3d& T_world_from, const Eigen::Isometry3d& T_world_to,
                    const Eigen::Isometry3d& T_from_to);

// chi^2 = error^T information error.
double edge_chi2(const PoseGraph& graph, const PoseEdge& edge);

// Of the body increments T_world_x <- T_world_x exp(eta): no lever arm to a far origin.
struct EdgeJacobians {
  Matrix6d d_error_d_from;
  Matrix6d d_error_d_to;
};
EdgeJacobians edge_jacobians(const Vector6d& error, const Eigen::Isometry3d& T_from_to);

// log(exp(xi + d)) to first order is inverse_left_jacobian(xi)^-1 d on the left: log(exp(e)
// exp(xi)) = xi + inverse_left_jacobian(xi) e. Barfoot, State Estimation for Robotics, Sec. 7.1.5,
// with rotation first.
Matrix6d inverse_left_jacobian(const Vector6d& xi);

}  // namespace sparsight
