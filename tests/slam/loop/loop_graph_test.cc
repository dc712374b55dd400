#include "slam/loop/loop_graph.h"

#include <gtest/gtest.h>

#include "slam/loop/candidate_filter.h"
#include "tests/slam/graph/made_graph.h"

namespace sparsight {
namespace {

LoopGraph chain_of(const MadeGraph& made) {
  LoopGraph graph(12.6);
  graph.begin_submap(made.truth[0]);
  for (std::size_t i = 0; i + 1 < made.truth.size(); ++i) {
    graph.add_next(made.graph.edges[i].T_from_to, made.graph.edges[i].information);
  }
  return graph;
}

TEST(LoopGraph, ATrueLoopTakesTheDriftOut) {
  const MadeGraph made({.nodes = 160, .per_lap = 100, .loops = 12});
  LoopGraph graph = chain_of(made);
  const double drift_m = made.error_m(graph.graph());
  for (const PoseEdge& edge : made.graph.edges) {
    if (edge.loop) {
      EXPECT_TRUE(graph.add_loop(edge.from, edge.to, edge.T_from_to, edge.information));
    }
  }
  EXPECT_LT(made.error_m(graph.graph()), 0.7 * drift_m);
}

TEST(LoopGraph, EvenTheFirstLoopMustBeWithinTheDriftOfOdometry) {
  const MadeGraph made({.nodes = 110, .per_lap = 100, .loops = 1});
  const PoseEdge& loop = made.graph.edges.back();
  LoopGraph graph = chain_of(made);
  const PoseGraph before = graph.graph();
  // The next door but one of a corridor whose doors are all alike.
  const Eigen::Isometry3d alike = loop.T_from_to * Eigen::Translation3d(0.0, 0.0, 5.0);
  EXPECT_FALSE(graph.add_loop(loop.from, loop.to, alike, loop.information));
  EXPECT_EQ(graph.graph().edges.size(), before.edges.size());
  EXPECT_EQ(graph.graph().T_world_node.back().matrix(), before.T_world_node.back().matrix());
  EXPECT_TRUE(graph.add_loop(loop.from, loop.to, loop.T_from_to, loop.information));
}

TEST(LoopGraph, ALoopThatTheOthersContradictIsRefused) {
  const MadeGraph made({.nodes = 200, .per_lap = 100, .loops = 40});
  LoopGraph graph = chain_of(made);
  const PoseEdge* last = nullptr;
  for (const PoseEdge& edge : made.graph.edges) {
    if (edge.loop) graph.add_loop(edge.from, edge.to, edge.T_from_to, edge.information);
    if (edge.loop) last = &edge;
  }
  const std::size_t edges = graph.graph().edges.size();
  // Ten times its own noise: odometry alone would allow it.
  const Eigen::Isometry3d off = last->T_from_to * Eigen::Translation3d(0.2, 0.0, 0.0);
  EXPECT_FALSE(graph.add_loop(last->from, last->to, off, last->information));
  EXPECT_EQ(graph.graph().edges.size(), edges);
}

TEST(CandidateFilter, AsksForTheSamePlaceSeveralTimesInARow) {
  CandidateFilter filter(3);
  EXPECT_TRUE(filter.next({{.place = 10, .similarity = 0.3F}}).empty());
  EXPECT_TRUE(filter.next({{.place = 12, .similarity = 0.3F}}).empty());
  EXPECT_EQ(filter.next({{.place = 15, .similarity = 0.3F}}), (std::vector<std::uint32_t>{15}));
  EXPECT_TRUE(filter.next({{.place = 40, .similarity = 0.9F}}).empty());
  EXPECT_TRUE(filter.next({}).empty());
  EXPECT_TRUE(filter.next({{.place = 15, .similarity = 0.3F}}).empty());
}

TEST(CandidateFilter, OfNeighboursItTakesTheMostSimilar) {
  CandidateFilter filter(1);
  EXPECT_EQ(filter.next({{8, 0.5F}, {10, 0.4F}, {30, 0.3F}}), (std::vector<std::uint32_t>{8, 30}));
}

}  // namespace
}  // namespace sparsight
