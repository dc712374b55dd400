#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "slam/loop/candidate_filter.h"
#include "slam/loop/known_places.h"
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
  bool in_earlier_map = false;  // the candidate: its sequence is then that of another session
};

// Where the graph has a keyframe.
struct PlacedKeyframe {
  std::uint64_t sequence = 0;
  bool in_earlier_map = false;  // which stands in this one's world once a loop has joined them
  std::size_t stored = 0;       // its number in the store
  CameraIntrinsics camera;      // of the stored image
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

// Keyframes between which odometry was never interrupted.
struct Submap {
  std::uint64_t first_keyframe = 0;  // sequence number
  std::size_t keyframes = 0;
  // The first keyframe of the oldest sub-map that loops connect it with: its own if there is none.
  // Sub-maps of different parts stand to each other as odometry guessed.
  std::uint64_t part = 0;
  bool in_earlier_map = false;  // loops connect it with that; its poses are in its frame
};

// What became of the queries, for people.
struct LoopStatistics {
  std::size_t keyframes = 0;
  std::size_t queries = 0;     // that found something similar
  std::size_t candidates = 0;  // that several queries agreed about, and were verified
  std::map<LoopCheck::Verdict, std::size_t> verdicts;
  std::size_t submaps_joined = 0;
  std::size_t joins_revised = 0;  // that later loops showed to be wrong
  std::size_t contradicted = 0;   // accepted by sight, but the graph speaks against them
};

// Sec. IV-E on one page: recognises places among the keyframes that left the window, verifies them,
// and keeps the pose graph. Where odometry lost its way a sub-map begins, which loops join to the
// rest once it is beyond doubt where it stands (JoinEvidence). Thread-bound, deterministic; no part
// of tracking waits for it.
class LoopCloser {
 public:
  // Images and clouds go to the store, which is in memory if none is given.
  LoopCloser(const OdometryConfig& config, std::shared_ptr<const Vocabulary> vocabulary,
             std::shared_ptr<KeyframeStore> store = nullptr);
  ~LoopCloser();

  // Goes on in an earlier map, whose keyframes are in the store already, in their order. Before the
  // first add(); what is added stands in a sub-map of its own until loops join it to the map.
  void resume(KnownPlaces earlier);
  // What the next session needs to do so: all that is known, the earlier map's included.
  KnownPlaces known() const;

  // The next keyframe of the odometry, seen through `camera`. It is asked about once its successors
  // have come, whose depth it borrows; without `search`, later still. True if poses have moved.
  bool add(const RetiredKeyframe& keyframe, const CameraIntrinsics& camera, bool search = true);
  // At the end: asks about the last ones.
  bool finish();

  // The odometry's frame in the map's, as the newest keyframe has it. Before any loop the identity;
  // every loop may make it jump.
  Eigen::Isometry3d T_map_odometry() const;
  // Whether the newest keyframe is connected with the first: if not, where its sub-map stands is a
  // guess.
  bool placed() const;
  // The poses of this session's keyframes so far, by their sequence.
  std::map<std::uint64_t, Eigen::Isometry3d> poses() const;
  // The same with what else the map needs to know of them, in the order they were added; first
  // those of the earlier map that loops connect this session with.
  std::vector<PlacedKeyframe> placed_keyframes() const;
  // This session's, in their order; all that it saw is in them.
  std::vector<Submap> submaps() const;
  // Loops that stand, in the order they were found.
  std::vector<LoopClosure> loops() const;
  const LoopStatistics& statistics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sparsight
