#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "slam/loop/candidate_filter.h"
#include "slam/loop/loop_config.h"
#include "slam/loop/loop_graph.h"
#include "slam/loop/loop_verification.h"
#include "slam/loop/place_database.h"
#include "slam/loop/vocabulary.h"
#include "slam/odometry.h"

namespace sparsight {

// A place seen again.
struct LoopClosure {
  std::uint64_t candidate = 0;  // sequence numbers of the two keyframes, the earlier first
  std::uint64_t current = 0;
  LoopCheck check;
};

// Keyframes between which odometry was never interrupted.
struct Submap {
  std::uint64_t first_keyframe = 0;  // sequence number
  std::size_t keyframes = 0;
  // The first keyframe of the oldest sub-map that loops connect it with: its own if there is none.
  // Sub-maps of different parts stand to each other as odometry guessed.
  std::uint64_t part = 0;
};

// What became of the queries, for people.
struct LoopStatistics {
  std::size_t keyframes = 0;
  std::size_t queries = 0;     // that found something similar
  std::size_t candidates = 0;  // that several queries agreed about, and were verified
  std::map<LoopCheck::Verdict, std::size_t> verdicts;
  std::size_t submaps_joined = 0;
  std::size_t contradicted = 0;  // accepted by sight, but the graph speaks against them
};

// Sec. IV-E on one page: recognises places among the keyframes that left the window, verifies them,
// and keeps the pose graph. Where odometry lost its way a sub-map begins, which loops join to the
// rest once it is beyond doubt where it stands (JoinEvidence). Thread-bound, deterministic; no part
// of tracking waits for it.
class LoopCloser {
 public:
  LoopCloser(const OdometryConfig& config, std::shared_ptr<const Vocabulary> vocabulary);
  ~LoopCloser();

  // The next keyframe of the odometry, seen through `camera`. It is asked about once its successors
  // have come, whose depth it borrows; without `search`, later still. True if poses have moved.
  bool add(const RetiredKeyframe& keyframe, const CameraIntrinsics& camera, bool search = true);
  // At the end: asks about the last ones.
  bool finish();

  // The poses of all keyframes so far, by their sequence.
  std::map<std::uint64_t, Eigen::Isometry3d> poses() const;
  // In their order; all that was seen is in them.
  std::vector<Submap> submaps() const;
  // Loops that stand, in the order they were found.
  std::vector<LoopClosure> loops() const;
  const LoopStatistics& statistics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sparsight
