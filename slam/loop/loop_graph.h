#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "slam/graph/graph_optimizer.h"

namespace sparsight {

// The pose graph as it grows: chains of keyframes, one for each sub-map, and loops that come and
// may go again. Sub-maps that no chain of edges connects stand where they were put; what is known
// of one says nothing of the other. Thread-bound, deterministic.
class LoopGraph {
 public:
  explicit LoopGraph(double dcs_phi) : dcs_phi_(dcs_phi) {}

  // Goes on from an earlier graph; before anything else.
  void resume(PoseGraph graph);
  // The first keyframe of a sub-map, put anywhere: no edge leads to it.
  void begin_submap(const Eigen::Isometry3d& T_world_keyframe);
  // The next keyframe, where the edge to it from the one before has it.
  void add_next(const Eigen::Isometry3d& T_last_next, const Matrix6d& information);

  // The first of the keyframes that edges connect it with.
  std::size_t part_of(std::size_t keyframe) const { return part_[keyframe]; }
  bool connected(std::size_t a, std::size_t b) const { return part_[a] == part_[b]; }

  // Between connected keyframes: optimises with the loop, from where the poses are. False, and all
  // as before, if the rest of the graph contradicts it: if believing it costs more than a true loop
  // would, which also tells of the first loop whether odometry can have drifted so far, or if its
  // own chi^2 stays too large. Other loops whose chi^2 becomes too large are taken out.
  bool add_loop(std::size_t from, std::size_t to, const Eigen::Isometry3d& T_from_to,
                const Matrix6d& information);
  // Between sub-maps that nothing connects, two loops or more, of which the first tells where the
  // one stands in the other and the rest are judged as above: the sub-map without the older first
  // keyframe moves rigidly onto the other, then all are optimised together. False, and all as
  // before, if the loops contradict each other.
  bool join(std::span<const PoseEdge> loops);

  // Whether a loop between the two keyframes of `loop` stands.
  bool has(const PoseEdge& loop) const;
  // As if these loops had never been found.
  LoopGraph without(std::span<const PoseEdge> loops) const;

  const PoseGraph& graph() const { return graph_; }
  const GraphSummary& last() const { return last_; }

 private:
  double dcs_phi_;
  PoseGraph graph_;
  std::vector<std::size_t> part_;  // see connected_parts()
  GraphSummary last_;
};

}  // namespace sparsight
