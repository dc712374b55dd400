#pragma once

#include <cstddef>
#include <vector>

#include "slam/graph/pose_graph.h"

namespace sparsight {

// Of each node, the first node that edges connect it with: what two nodes have in common if edges
// lead from one to the other.
std::vector<std::size_t> connected_parts(const PoseGraph& graph);

}  // namespace sparsight
