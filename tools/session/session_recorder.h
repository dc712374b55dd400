#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <vector>

#include "slam/map/voxel_map.h"
#include "tools/session/atomic_file.h"
#include "tools/session/session.h"

namespace sparsight {

// Gathers a session as it runs and writes its folder. The journal grows as frames come; all else is
// written at the end, each file appearing when it is whole and session.json last. Thread-bound, but
// frames and keyframes may be added by two threads, each by its own.
class SessionRecorder {
 public:
  // Without `map` none is kept or written. kAtOnce: the journal and the poses as they are tracked
  // stand under their names from the start, for a run that may be cut off at any moment.
  SessionRecorder(std::filesystem::path folder, SessionDescription description, bool map,
                  AtomicFile::Appears journal = AtomicFile::Appears::kWhole);

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
  Result<void> write_odometry();
  Result<void> write_map();

  std::filesystem::path folder_;
  Session session_;
  std::optional<VoxelMap> map_;
  std::vector<RetiredKeyframe> unplaced_;  // of a map that waits for loops
  AtomicFile journal_;
  std::optional<AtomicFile> poses_;  // as tracked; replaced by the final ones at the end
};

}  // namespace sparsight
