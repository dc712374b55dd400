#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hal/result.h"
#include "slam/graph/pose_graph.h"

namespace sparsight {

// A graph of 3D poses in g2o's text format: VERTEX_SE3:QUAT, EDGE_SE3:QUAT and FIX lines.
//
// Edges between vertices whose ids do not follow each other are loops, and so is a second edge
// between two that do. The information is taken as that of [x y z, rotation vector] of the error
// Z^-1 T_from^-1 T_to, as GTSAM, SE-Sync and Ceres' example do; g2o itself measures a rotation by
// the vector part of its quaternion, half as long.
struct G2oGraph {
  PoseGraph graph;
  std::vector<std::int64_t> ids;         // of the nodes
  std::vector<std::string> edge_fields;  // each edge's line as it was, to be written back
};

// `source` names the text in errors: "FILE:LINE: what is wrong; what would be right".
Result<G2oGraph> parse_g2o(std::string_view text, const std::string& source);

// Vertices where graph.T_world_node has them, then the held ones, then the edges. Edges in
// `taken_out` (ascending) are left as comments.
std::string format_g2o(const G2oGraph& file, const std::vector<std::size_t>& taken_out);

}  // namespace sparsight
