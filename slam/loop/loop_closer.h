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
#include "slam/map/keyframe_store.h"
#include "slam/odometry.h"

namespace sparsight {

// A place seen again.
struct LoopClosure {
  std::uint64_t candidate = 0;  // sequence numbers of the two keyframes, the earlier first
  std::uint64_t current = 0;
  LoopCheck check;
};

// Where the graph has a keyframe.
struct PlacedKeyframe {
  std::uint64_t sequence = 0;
  std::size_t stored = 0;   // its number in the store
  CameraIntrinsics camera;  // of the stored image
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

// What became of the queries, for people.
struct LoopStatistics {
  std::size_t keyframes = 0;
  std::size_t queries = 0;     // that found something similar
  std::size_t candidates = 0;  // that several queries agreed about, and were verified
  std::map<LoopCheck::Verdict, std::size_t> verdicts;
  std::size_t contradicted = 0;  // accepted by sight, but the graph speaks against them
};

// Sec. IV-E on one page: recognises places among the keyframes that left the window, verifies them,
// and keeps the pose graph. Thread-bound, deterministic; no part of tracking waits for it.
class LoopCloser {
 public:
  // Images and clouds go to the store, which is in memory if none is given.
  LoopCloser(const OdometryConfig& config, std::shared_ptr<const Vocabulary> vocabulary,
             std::shared_ptr<KeyframeStore> store = nullptr);
  ~LoopCloser();

  // The next keyframe of the odometry, seen through `camera`. It is asked about once its successors
  // have come, whose depth it borrows; without `search`, later still. True if poses have moved.
  bool add(const RetiredKeyframe& keyframe, const CameraIntrinsics& camera, bool search = true);
  // At the end: asks about the last ones.
  bool finish();

  // The poses of all keyframes so far, by their sequence.
  std::map<std::uint64_t, Eigen::Isometry3d> poses() const;
  // The same with what else the map needs to know of them, in the order they were added.
  std::vector<PlacedKeyframe> placed() const;
  // Loops that stand, in the order they were found.
  std::vector<LoopClosure> loops() const;
  const LoopStatistics& statistics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sparsight
