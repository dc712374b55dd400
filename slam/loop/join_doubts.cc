#include "slam/loop/join_doubts.h"

#include <algorithm>
#include <utility>

namespace sparsight {
namespace {

std::vector<PoseEdge> edges_of(const std::vector<SeenAgain>& loops) {
  std::vector<PoseEdge> edges;
  edges.reserve(loops.size());
  for (const SeenAgain& loop : loops) edges.push_back(loop.edge());
  return edges;
}

// What stands is as sure as a loop must be.
SeenAgain as_evidence(const PoseEdge& edge, const SubmapJoinConfig& config) {
  return {.current = edge.from,
          .candidate = edge.to,
          .check = {.T_current_candidate = edge.T_from_to,
                    .information = edge.information,
                    .pose_inliers = config.min_pose_inliers,
                    .found_share = config.min_found_share}};
}

}  // namespace

std::optional<RevisedJoin> JoinDoubts::add(const SeenAgain& loop, const LoopGraph& graph,
                                           const SubmapOf& submap_of) {
  const auto submaps = [&](std::size_t a, std::size_t b) {
    return std::pair(std::minmax({submap_of(a), submap_of(b)}));
  };
  const auto two = submaps(loop.current, loop.candidate);
  if (two.first == two.second) return std::nullopt;
  refused_.push_back(loop);
  std::vector<SeenAgain> against;
  for (const SeenAgain& other : refused_) {
    if (submaps(other.current, other.candidate) == two) against.push_back(other);
  }
  std::vector<SeenAgain> standing;
  for (const PoseEdge& edge : graph.graph().edges) {
    if (edge.loop && submaps(edge.from, edge.to) == two) {
      standing.push_back(as_evidence(edge, config_));
    }
  }
  if (against.size() < standing.size() + static_cast<std::size_t>(config_.min_loops)) {
    return std::nullopt;
  }
  LoopGraph apart = graph.without(edges_of(standing));
  if (apart.connected(loop.current, loop.candidate)) return std::nullopt;
  JoinEvidence evidence(config_);
  for (const SeenAgain& other : standing) evidence.add(other, apart);
  std::vector<SeenAgain> agreeing;
  for (const SeenAgain& other : against) agreeing = evidence.add(other, apart);
  if (agreeing.empty() || !apart.join(edges_of(agreeing))) return std::nullopt;
  std::erase_if(refused_, [&](const SeenAgain& other) { return apart.has(other.edge()); });
  return RevisedJoin{std::move(apart), std::move(agreeing)};
}

}  // namespace sparsight
