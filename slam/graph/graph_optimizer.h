#pragma once

#include <cstddef>
#include <vector>

#include "slam/graph/pose_graph.h"

namespace sparsight {

struct GraphOptimizerConfig {
  int max_iterations = 50;
  double relative_tolerance = 1e-6;  // of the cost, per iteration: below, it has converged
  // Phi of Dynamic Covariance Scaling on the loops; 0: plain least squares.
  double dcs_phi = 12.6;  // 95 % of true loops lie below: chi^2 of six degrees of freedom
};

struct GraphSummary {
  double initial_cost = 0.0;  // sum of chi^2, those of loops as the robust cost has them
  double final_cost = 0.0;
  int iterations = 0;
  bool converged = false;
};

// Levenberg–Marquardt over all poses, from where they are: after a new loop, the poses of the last
// time are the warm start.
GraphSummary optimize(PoseGraph& graph, const GraphOptimizerConfig& config);

// The cost that optimize() descends.
double graph_cost(const PoseGraph& graph, double dcs_phi);

// The chi^2 that no true loop of an optimised graph reaches, as measured by the median of all loops
// where that is larger than it should be.
double impossible_chi2(const PoseGraph& graph);
// Loops that the rest of an optimised graph contradicts: edges beyond it. Indices, ascending.
std::vector<std::size_t> contradicted_loops(const PoseGraph& graph);

}  // namespace sparsight
