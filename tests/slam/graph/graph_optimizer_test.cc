#include "slam/graph/graph_optimizer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "slam/graph/chordal_start.h"
#include "slam/graph/cold_solution.h"
#include "slam/graph/dynamic_covariance_scaling.h"
#include "slam/graph/edge_error.h"
#include "tests/slam/graph/made_graph.h"

namespace sparsight {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr GraphOptimizerConfig kLeastSquares{.dcs_phi = 0.0};

// Gauss–Newton with a dense matrix, as the equations are written: what the solver must agree with.
double solve_densely(PoseGraph& graph, int iterations) {
  const auto size = static_cast<Eigen::Index>(6 * graph.T_world_node.size());
  for (int iteration = 0; iteration < iterations; ++iteration) {
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(size);
    for (const PoseEdge& edge : graph.edges) {
      const Vector6d error =
          edge_error(graph.T_world_node[edge.from], graph.T_world_node[edge.to], edge.T_from_to);
      const EdgeJacobians J = edge_jacobians(error, edge.T_from_to);
      const auto i = static_cast<Eigen::Index>(6 * edge.from);
      const auto j = static_cast<Eigen::Index>(6 * edge.to);
      const Matrix6d& W = edge.information;
      H.block<6, 6>(i, i) += J.d_error_d_from.transpose() * W * J.d_error_d_from;
      H.block<6, 6>(j, j) += J.d_error_d_to.transpose() * W * J.d_error_d_to;
      H.block<6, 6>(i, j) += J.d_error_d_from.transpose() * W * J.d_error_d_to;
      H.block<6, 6>(j, i) += J.d_error_d_to.transpose() * W * J.d_error_d_from;
      b.segment<6>(i) += J.d_error_d_from.transpose() * W * error;
      b.segment<6>(j) += J.d_error_d_to.transpose() * W * error;
    }
    const Eigen::Index free = size - 6;
    const Eigen::VectorXd step = -H.bottomRightCorner(free, free).ldlt().solve(b.tail(free));
    for (std::size_t node = 1; node < graph.T_world_node.size(); ++node) {
      const Vector6d eta = step.segment<6>(static_cast<Eigen::Index>(6 * (node - 1)));
      graph.T_world_node[node] = graph.T_world_node[node] * exp_se3(eta);
    }
  }
  return graph_cost(graph, 0.0);
}

TEST(GraphOptimizer, FindsWhatADenseSolverFinds) {
  const MadeGraph made({.nodes = 60, .per_lap = 20, .loops = 12});
  PoseGraph dense = made.graph;
  const double cost = solve_densely(dense, 12);
  PoseGraph graph = made.graph;
  const GraphSummary summary = optimize(graph, {.relative_tolerance = 1e-12, .dcs_phi = 0.0});
  EXPECT_TRUE(summary.converged);
  EXPECT_NEAR(summary.final_cost, cost, 1e-6 * cost);
  EXPECT_NEAR(graph_cost(graph, 0.0), summary.final_cost, 1e-6 * cost);
  for (std::size_t i = 0; i < graph.T_world_node.size(); ++i) {
    EXPECT_TRUE(graph.T_world_node[i].isApprox(dense.T_world_node[i], 1e-5)) << i;
  }
}

TEST(GraphOptimizer, LoopsTakeTheDriftOut) {
  const MadeGraph made({});
  PoseGraph graph = made.graph;
  optimize(graph, {});
  EXPECT_LT(made.error_m(graph), 0.4 * made.error_m(made.graph));
}

TEST(GraphOptimizer, FalseLoopsHardlyMoveAnything) {
  const MadeGraph clean({});
  PoseGraph clean_solution = clean.graph;
  optimize(clean_solution, {});
  const MadeGraph dirty({.false_loops = 46});  // 10 % of all edges, three in seven of the loops
  PoseGraph graph = dirty.graph;
  optimize(graph, {});
  EXPECT_LT(dirty.error_m(graph), 2.0 * clean.error_m(clean_solution));
  // They would, without the scaling.
  PoseGraph plain = dirty.graph;
  optimize(plain, kLeastSquares);
  EXPECT_GT(dirty.error_m(plain), 10.0 * clean.error_m(clean_solution));
}

TEST(GraphOptimizer, ContradictedLoopsAreTheFalseOnes) {
  const MadeGraph made({.false_loops = 6});
  PoseGraph graph = made.graph;
  optimize(graph, {});
  std::vector<std::size_t> expected;
  for (std::size_t i = made.true_edges; i < made.graph.edges.size(); ++i) expected.push_back(i);
  EXPECT_EQ(contradicted_loops(graph), expected);
  const MadeGraph clean({});
  graph = clean.graph;
  optimize(graph, {});
  EXPECT_THAT(contradicted_loops(graph), IsEmpty());
}

TEST(GraphOptimizer, AWarmStartNeedsFewerIterations) {
  MadeGraph made({});
  const PoseEdge newest = made.graph.edges.back();
  made.graph.edges.pop_back();
  PoseGraph graph = made.graph;
  optimize(graph, {});
  graph.edges.push_back(newest);
  const GraphSummary warm = optimize(graph, {});
  PoseGraph cold = made.graph;
  cold.edges.push_back(newest);
  const GraphSummary from_cold = optimize(cold, {});
  EXPECT_LT(warm.iterations, from_cold.iterations);
  EXPECT_NEAR(warm.final_cost, from_cold.final_cost, 1e-3 * from_cold.final_cost);
}

TEST(GraphOptimizer, PartsThatNothingConnectsAreHeldEach) {
  PoseGraph graph;
  for (int i = 0; i < 4; ++i) graph.T_world_node.push_back(Eigen::Isometry3d::Identity());
  graph.T_world_node[2].translation().x() = 5.0;
  const Eigen::Isometry3d ahead(Eigen::Translation3d(0.0, 0.0, 1.0));
  graph.edges = {{.from = 0, .to = 1, .T_from_to = ahead},
                 {.from = 2, .to = 3, .T_from_to = ahead}};
  optimize(graph, {});
  EXPECT_TRUE(graph.T_world_node[2].translation().isApprox(Eigen::Vector3d(5.0, 0.0, 0.0), 1e-9));
  EXPECT_TRUE(graph.T_world_node[3].translation().isApprox(Eigen::Vector3d(5.0, 0.0, 1.0), 1e-9));
}

TEST(GraphOptimizer, HoldsWhatItIsToldToHold) {
  PoseGraph graph;
  graph.T_world_node.assign(2, Eigen::Isometry3d::Identity());
  graph.edges = {{.T_from_to = Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 1.0))}};
  graph.edges[0].to = 1;
  graph.held = {1};
  optimize(graph, {});
  EXPECT_TRUE(graph.T_world_node[0].translation().isApprox(Eigen::Vector3d(0.0, 0.0, -1.0), 1e-9));
}

TEST(GraphOptimizer, NothingIsNoGraph) {
  PoseGraph graph;
  EXPECT_EQ(optimize(graph, {}).final_cost, 0.0);
  EXPECT_THAT(contradicted_loops(graph), IsEmpty());
  EXPECT_TRUE(chordal_start(graph).T_world_node.empty());
}

TEST(DynamicCovarianceScaling, LeavesSmallErrorsAndBoundsLargeOnes) {
  EXPECT_EQ(dcs_scale(0.5, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(dcs_scale(3.0, 1.0), 0.5);  // 2 Phi / (Phi + chi^2)
  EXPECT_EQ(dcs_cost(0.5, 1.0).value, 0.5);
  EXPECT_LT(dcs_cost(1e12, 1.0).value, 3.0);
}

TEST(DynamicCovarianceScaling, CostIsSmoothAndItsSlopeIsTheScaleSquared) {
  EXPECT_NEAR(dcs_cost(1.0 + 1e-12, 1.0).value, 1.0, 1e-9);
  for (const double chi2 : {0.5, 1.5, 4.0, 50.0}) {
    const double step = 1e-5;
    const RobustCost cost = dcs_cost(chi2, 1.0);
    const RobustCost before = dcs_cost(chi2 - step, 1.0);
    const RobustCost after = dcs_cost(chi2 + step, 1.0);
    EXPECT_NEAR(cost.first, (after.value - before.value) / (2.0 * step), 1e-8);
    EXPECT_NEAR(cost.second, (after.first - before.first) / (2.0 * step), 1e-8);
    EXPECT_NEAR(cost.first, dcs_scale(chi2, 1.0) * dcs_scale(chi2, 1.0), 1e-15);
  }
}

TEST(ChordalStart, IsNearTheTruthWhereverTheNodesWere) {
  MadeGraph made({.nodes = 120, .per_lap = 40, .loops = 30});
  PoseGraph scattered = made.graph;
  for (std::size_t i = 1; i < scattered.T_world_node.size(); ++i) {
    scattered.T_world_node[i] = exp_se3(Vector6d::Constant(0.1 * static_cast<double>(i % 17)));
  }
  EXPECT_LT(made.error_m(chordal_start(scattered)), 0.3);
}

TEST(ColdSolution, IsTheLeastSquaresOptimumOfTheTrueLoops) {
  const MadeGraph clean({.nodes = 150, .per_lap = 50, .loops = 40});
  MadeGraph dirty({.nodes = 150, .per_lap = 50, .loops = 40, .false_loops = 4});
  const ColdSolution expected = solve_from_cold(clean.graph, {});
  EXPECT_THAT(expected.taken_out, IsEmpty());
  // From poses that say nothing.
  for (Eigen::Isometry3d& T : dirty.graph.T_world_node) T = dirty.graph.T_world_node[0];
  const ColdSolution found = solve_from_cold(dirty.graph, {});
  EXPECT_THAT(found.taken_out, ElementsAre(dirty.true_edges, dirty.true_edges + 1,
                                           dirty.true_edges + 2, dirty.true_edges + 3));
  EXPECT_NEAR(found.final_cost, expected.final_cost, 1e-3 * expected.final_cost);
}

}  // namespace
}  // namespace sparsight
