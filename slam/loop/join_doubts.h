#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "slam/loop/join_evidence.h"

namespace sparsight {

struct RevisedJoin {
  LoopGraph graph;
  std::vector<SeenAgain> loops;  // by which the two sub-maps are joined now
};

// Loops that the graph has refused, between two sub-maps that other loops have joined. Those may
// have been of look-alikes that agreed. Thread-bound, deterministic.
class JoinDoubts {
 public:
  using SubmapOf = std::function<std::size_t(std::size_t keyframe)>;

  explicit JoinDoubts(const SubmapJoinConfig& config) : config_(config) {}

  // The next that was refused. If it and those before it that say the same outnumber all that say
  // otherwise, the standing ones too, as JoinEvidence asks for, the join is taken apart and made
  // anew where they say. Nothing: it stays; also where further sub-maps hold the two together.
  std::optional<RevisedJoin> add(const SeenAgain& loop, const LoopGraph& graph,
                                 const SubmapOf& submap_of);

 private:
  SubmapJoinConfig config_;
  std::vector<SeenAgain> refused_;
};

}  // namespace sparsight
