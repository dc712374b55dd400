#pragma once

#include "slam/graph/pose_graph.h"

namespace sparsight {

// Poses that do not depend on where the nodes stand: rotations as the least-squares problem that is
// left if they may be any matrices, each then moved to the nearest rotation; positions by the
// linear problem for these rotations (Carlone, Tron, Daniilidis and Dellaert, "Initialization
// techniques for 3D SLAM", ICRA 2015, Sec. III-B). From there a descent reaches the global optimum
// of all but very noisy graphs. Of each part of the graph the first node keeps its pose.
PoseGraph chordal_start(PoseGraph graph);

}  // namespace sparsight
