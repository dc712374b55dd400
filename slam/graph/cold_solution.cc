#include "slam/graph/cold_solution.h"

#include <algorithm>
#include <utility>

#include "slam/graph/chordal_start.h"
#include "slam/graph/edge_error.h"

namespace sparsight {
namespace {

constexpr double kPhiStep = 0.25;
constexpr int kIterationsPerStep = 5;
constexpr int kGlimpse = 20;
constexpr double kGlimpseTolerance = 1e-3;
constexpr double kWorthATry = 5.0;  // of the chi^2 that no true loop reaches

PoseGraph without(const PoseGraph& graph, const std::vector<std::size_t>& edges) {
  PoseGraph result = graph;
  result.edges.clear();
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (!std::ranges::binary_search(edges, i)) result.edges.push_back(graph.edges[i]);
  }
  return result;
}

double largest_loop_chi2(const PoseGraph& graph) {
  double largest = 0.0;
  for (const PoseEdge& edge : graph.edges) {
    if (edge.loop) largest = std::max(largest, edge_chi2(graph, edge));
  }
  return largest;
}

class ColdSolver {
 public:
  ColdSolver(const PoseGraph& graph, const GraphOptimizerConfig& config)
      : given_(graph), config_(config) {}

  ColdSolution solve() {
    PoseGraph best = better(glimpse(given_, 0.0), glimpse(chordal_start(given_), 0.0), 0.0);
    std::vector<std::size_t> taken_out;
    if (config_.dcs_phi > 0.0 && !contradicted_loops(best).empty()) {
      const double phi = config_.dcs_phi;
      // The poses as given carry no false loop yet; the solution of least squares carries all.
      best = better(glimpse(given_, phi), graduated(std::move(best)), phi);
      taken_out = contradicted_loops(best);
      best = without(best, taken_out);
    }
    GraphSummary last = to_the_end(best);
    take_back(best, taken_out, last);
    return {.graph = std::move(best),
            .taken_out = std::move(taken_out),
            .initial_cost = graph_cost(given_, 0.0),
            .final_cost = last.final_cost,
            .iterations = iterations_,
            .converged = last.converged};
  }

 private:
  GraphSummary to_the_end(PoseGraph& graph) {
    GraphOptimizerConfig least_squares = config_;
    least_squares.dcs_phi = 0.0;
    return descend(graph, least_squares);
  }

  // Beside false loops a true one may have looked contradicted, and then the poses gave way.
  void take_back(PoseGraph& best, std::vector<std::size_t>& taken_out, GraphSummary& last) {
    const double impossible = impossible_chi2(best);
    for (const std::size_t candidate : std::vector(taken_out)) {
      if (edge_chi2(best, given_.edges[candidate]) > kWorthATry * impossible) continue;
      std::vector<std::size_t> others = taken_out;
      std::erase(others, candidate);
      PoseGraph with = given_;
      with.T_world_node = best.T_world_node;
      with = without(with, others);
      const GraphSummary tried = to_the_end(with);
      if (tried.final_cost - last.final_cost > impossible) continue;
      best = std::move(with);
      taken_out = std::move(others);
      last = tried;
    }
  }

  GraphSummary descend(PoseGraph& graph, const GraphOptimizerConfig& config) {
    const GraphSummary summary = optimize(graph, config);
    iterations_ += summary.iterations;
    return summary;
  }

  // Far enough to see where a start leads.
  PoseGraph glimpse(PoseGraph graph, double phi) {
    descend(graph, {.max_iterations = std::min(kGlimpse, config_.max_iterations),
                    .relative_tolerance = kGlimpseTolerance,
                    .dcs_phi = phi});
    return graph;
  }

  PoseGraph graduated(PoseGraph graph) {
    for (double phi = largest_loop_chi2(graph); phi > config_.dcs_phi; phi *= kPhiStep) {
      descend(graph, {.max_iterations = std::min(kIterationsPerStep, config_.max_iterations),
                      .relative_tolerance = kGlimpseTolerance,
                      .dcs_phi = phi});
    }
    return glimpse(std::move(graph), config_.dcs_phi);
  }

  static PoseGraph better(PoseGraph a, PoseGraph b, double phi) {
    return graph_cost(a, phi) <= graph_cost(b, phi) ? std::move(a) : std::move(b);
  }

  const PoseGraph& given_;
  GraphOptimizerConfig config_;
  int iterations_ = 0;
};

}  // namespace

ColdSolution solve_from_cold(const PoseGraph& graph, const GraphOptimizerConfig& config) {
  return ColdSolver(graph, config).solve();
}

}  // namespace sparsight
