#pragma once

#include <cstddef>
#include <vector>

#include "slam/loop/loop_config.h"
#include "slam/loop/loop_graph.h"
#include "slam/loop/loop_verification.h"

namespace sparsight {

// Two keyframes that were found to show one place; nodes of the graph.
struct SeenAgain {
  std::size_t current = 0;
  std::size_t candidate = 0;
  LoopCheck check;

  PoseEdge edge() const {
    return {.from = current,
            .to = candidate,
            .T_from_to = check.T_current_candidate,
            .information = check.information,
            .loop = true};
  }
};

// Loops between sub-maps that nothing connects yet. One of them may be of a look-alike, and nothing
// is there that would contradict it; so it waits until another, of a view elsewhere, says the same.
// Thread-bound, deterministic.
class JoinEvidence {
 public:
  explicit JoinEvidence(const SubmapJoinConfig& config) : config_(config) {}

  // A loop accepted by sight. Returns it and those before it that say the same of the two sub-maps,
  // if they are enough to join them; otherwise nothing.
  std::vector<SeenAgain> add(const SeenAgain& loop, const LoopGraph& graph);
  // What lies between keyframes that are connected by now is no longer waited with.
  void drop_connected(const LoopGraph& graph);
  std::size_t waiting() const { return waiting_.size(); }

 private:
  bool sure(const LoopCheck& check) const;
  bool agree(const SeenAgain& a, const SeenAgain& b, const PoseGraph& graph, bool crosswise) const;
  bool apart(const SeenAgain& a, const SeenAgain& b, const PoseGraph& graph, bool crosswise) const;

  SubmapJoinConfig config_;
  std::vector<SeenAgain> waiting_;
};

}  // namespace sparsight
