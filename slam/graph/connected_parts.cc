#include "slam/graph/connected_parts.h"

#include <algorithm>
#include <numeric>

namespace sparsight {

std::vector<std::size_t> connected_parts(const PoseGraph& graph) {
  std::vector<std::size_t> part(graph.T_world_node.size());
  std::iota(part.begin(), part.end(), std::size_t{0});
  const auto root = [&](std::size_t node) {
    while (part[node] != node) node = part[node] = part[part[node]];
    return node;
  };
  for (const PoseEdge& edge : graph.edges) {
    const auto [low, high] = std::minmax({root(edge.from), root(edge.to)});
    part[high] = low;
  }
  for (std::size_t node = 0; node < part.size(); ++node) part[node] = root(node);
  return part;
}

}  // namespace sparsight
