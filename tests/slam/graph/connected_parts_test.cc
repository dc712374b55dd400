#include "slam/graph/connected_parts.h"

#include <gtest/gtest.h>

namespace sparsight {
namespace {

PoseGraph graph_of(std::size_t nodes, std::vector<std::pair<std::size_t, std::size_t>> edges) {
  PoseGraph graph;
  graph.T_world_node.resize(nodes, Eigen::Isometry3d::Identity());
  for (const auto& [from, to] : edges) graph.edges.push_back({.from = from, .to = to});
  return graph;
}

TEST(ConnectedParts, AreNamedByTheirFirstNodes) {
  using Parts = std::vector<std::size_t>;
  EXPECT_EQ(connected_parts(graph_of(5, {{0, 1}, {2, 3}})), (Parts{0, 0, 2, 2, 4}));
  EXPECT_EQ(connected_parts(graph_of(5, {{3, 2}, {4, 0}, {2, 4}})), (Parts{0, 1, 0, 0, 0}))
      << "whichever way an edge points, and however late it comes";
  EXPECT_EQ(connected_parts({}), Parts{});
}

}  // namespace
}  // namespace sparsight
