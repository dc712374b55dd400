#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "slam/map/map_composer.h"
#include "slam/map/voxel_map.h"
#include "tools/cloud/cloud_file.h"
#include "tools/map/paged_keyframes.h"
#include "tools/session/atomic_file.h"
#include "tools/session/session.h"

namespace sparsight {

// Gathers a session as it runs and writes its folder. The journal grows as frames come; all else is
// written at the end, each file appearing when it is whole and session.json last. Thread-bound, but
// frames and keyframes may be added by two threads, each by its own.
class SessionRecorder {
 public:
  // map: the formats it is written in; none: no map is kept. kAtOnce: the journal and the poses as
  // they are tracked stand under their names from the start, for a run that may be cut off at any
  // moment.
  SessionRecorder(std::filesystem::path folder, SessionDescription description,
                  std::vector<CloudFormat> map,
                  AtomicFile::Appears journal = AtomicFile::Appears::kWhole);

  // Where a LoopCloser of this session is to keep images and clouds, of which the map is then made:
  // in a file that is gone when the session is written, unless another is given before begin().
  std::shared_ptr<PagedKeyframes> keyframes() { return keyframes_; }

  // Marks a new folder as a session's, so that after a crash it may be replaced.
  Result<void> begin();
  // Returns the frame's faults that are the first of their kind.
  std::vector<Error> add(const FrameRecord& record);
  void add(const RetiredKeyframe& keyframe);
  // An empty trajectory (a run that broke off) stands for the poses as they were when tracked.
  void end(ReplayTrajectories trajectories, std::chrono::nanoseconds wall_time);
  Result<void> write();

  Session& session() { return session_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  void compose_map(const std::vector<PlacedKeyframe>& placed);
  void note_keyframes();
  Result<void> write_odometry();
  Result<void> write_map();

  std::filesystem::path folder_;
  Session session_;
  std::vector<CloudFormat> formats_;
  std::optional<VoxelMap> map_;
  std::optional<MapComposer> composer_;        // into map_
  std::shared_ptr<PagedKeyframes> keyframes_;  // of a map that waits for loops
  AtomicFile journal_;
  std::optional<AtomicFile> poses_;  // as tracked; replaced by the final ones at the end
};

}  // namespace sparsight
