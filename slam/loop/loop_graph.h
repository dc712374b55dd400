#pragma once

#include <cstddef>
#include <vector>

#include "slam/graph/graph_optimizer.h"

namespace sparsight {

// The pose graph as it grows: a chain of keyframes, and loops that come and may go again.
// Thread-bound, deterministic.
class LoopGraph {
 public:
  explicit LoopGraph(double dcs_phi) : dcs_phi_(dcs_phi) {}

  // The next keyframe, where the edge to it from the one before has it.
  void add_first(const Eigen::Isometry3d& T_world_keyframe);
  void add_next(const Eigen::Isometry3d& T_last_next, const Matrix6d& information);

  // Optimises with the loop, from where the poses are. False, and all as before, if the rest of the
  // graph contradicts it: if believing it costs more than a true loop would, which also tells of
  // the first loop whether odometry can have drifted so far, or if its own chi^2 stays too large.
  // Other loops whose chi^2 becomes too large are taken out.
  bool add_loop(std::size_t from, std::size_t to, const Eigen::Isometry3d& T_from_to,
                const Matrix6d& information);

  const PoseGraph& graph() const { return graph_; }
  const GraphSummary& last() const { return last_; }

 private:
  double dcs_phi_;
  PoseGraph graph_;
  GraphSummary last_;
};

}  // namespace sparsight
