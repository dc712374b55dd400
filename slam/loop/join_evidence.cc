#include "slam/loop/join_evidence.h"

#include <algorithm>
#include <cmath>

#include "slam/geometry/se3.h"

namespace sparsight {
namespace {

// The loop as seen from its other end, and so in the order of another one.
struct Directed {
  std::size_t from = 0;
  std::size_t to = 0;
  Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity();
};

Directed directed(const SeenAgain& loop, bool turned) {
  const Eigen::Isometry3d& T = loop.check.T_current_candidate;
  if (turned) return {loop.candidate, loop.current, T.inverse()};
  return {loop.current, loop.candidate, T};
}

// Of two keyframes of one sub-map.
Eigen::Isometry3d between(const PoseGraph& graph, std::size_t a, std::size_t b) {
  return graph.T_world_node[a].inverse() * graph.T_world_node[b];
}

}  // namespace

bool JoinEvidence::sure(const LoopCheck& check) const {
  return check.pose_inliers >= config_.min_pose_inliers &&
         check.found_share >= config_.min_found_share;
}

// What `a` says of the two views of `b`, against what `b` says.
bool JoinEvidence::agree(const SeenAgain& a, const SeenAgain& b, const PoseGraph& graph,
                         bool crosswise) const {
  const Directed one = directed(a, false);
  const Directed other = directed(b, crosswise);
  const Eigen::Isometry3d T_other_one = between(graph, other.from, one.from);
  const Eigen::Isometry3d T_one_other = between(graph, one.to, other.to);
  const Eigen::Isometry3d expected = T_other_one * one.T_from_to * T_one_other;
  const double way_m = T_other_one.translation().norm() + T_one_other.translation().norm();
  const Eigen::Isometry3d difference = expected.inverse() * other.T_from_to;
  return difference.translation().norm() <=
             config_.max_disagreement_m + config_.max_disagreement_share * way_m &&
         rotation_deg(difference) <= config_.max_disagreement_deg;
}

bool JoinEvidence::apart(const SeenAgain& a, const SeenAgain& b, const PoseGraph& graph,
                         bool crosswise) const {
  const Eigen::Isometry3d T = between(graph, a.current, directed(b, crosswise).from);
  return T.translation().norm() >= config_.min_apart_m || rotation_deg(T) >= config_.min_apart_deg;
}

std::vector<SeenAgain> JoinEvidence::add(const SeenAgain& loop, const LoopGraph& graph) {
  if (!sure(loop.check)) return {};
  // Asked about again, with more depth: one piece of evidence still.
  std::erase_if(waiting_, [&](const SeenAgain& other) {
    return other.current == loop.current && other.candidate == loop.candidate;
  });
  std::vector<SeenAgain> agreeing{loop};
  int against = 0;
  bool from_elsewhere = false;
  for (const SeenAgain& other : waiting_) {
    const bool straight = graph.connected(loop.current, other.current) &&
                          graph.connected(loop.candidate, other.candidate);
    const bool crosswise = graph.connected(loop.current, other.candidate) &&
                           graph.connected(loop.candidate, other.current);
    if (!straight && !crosswise) continue;
    if (agree(loop, other, graph.graph(), crosswise)) {
      agreeing.push_back(other);
      from_elsewhere = from_elsewhere || apart(loop, other, graph.graph(), crosswise);
    } else {
      ++against;
    }
  }
  waiting_.push_back(loop);
  const bool enough = static_cast<int>(agreeing.size()) >= config_.min_loops + against;
  return enough && from_elsewhere ? agreeing : std::vector<SeenAgain>{};
}

void JoinEvidence::drop_connected(const LoopGraph& graph) {
  std::erase_if(waiting_, [&](const SeenAgain& loop) {
    return graph.connected(loop.current, loop.candidate);
  });
}

}  // namespace sparsight
