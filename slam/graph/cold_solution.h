#pragma once

#include <cstddef>
#include <vector>

#include "slam/graph/graph_optimizer.h"

namespace sparsight {

struct ColdSolution {
  PoseGraph graph;                     // without the loops that were taken out
  std::vector<std::size_t> taken_out;  // edges of the given graph, ascending
  double initial_cost = 0.0;           // sum of chi^2 over all edges as given
  double final_cost = 0.0;             // sum of chi^2 over the edges that are left
  int iterations = 0;                  // over all starts
  bool converged = false;
};

// Solves a graph whose poses may be far from right and whose loops may be wrong. Plain least
// squares from the poses given and from chordal_start(); if the better of the two contradicts some
// loops, Dynamic Covariance Scaling whose Phi comes down step by step, the contradicted ones are
// taken out, and least squares again over what is left; a loop that then costs no more than a true
// one may is put back. A graph without false loops thus gets its least-squares optimum exactly.
ColdSolution solve_from_cold(const PoseGraph& graph, const GraphOptimizerConfig& config);

}  // namespace sparsight
