#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "realtime/pipeline/frame_record.h"

namespace sparsight {

// Frames hang on keyframes; they are placed once their keyframe's pose is final. A frame that was
// lost has no place, unless it became a keyframe itself; nor have those before it that were in
// question when tracking was given up. Thread-bound.
class AnchoredTrajectory {
 public:
  void add(std::uint64_t sequence, HostTime exposure, const FrameOutcome& outcome);
  // The pose with which the keyframe has left the window.
  void settle(std::uint64_t keyframe, const Eigen::Isometry3d& T_world_keyframe);
  // One per frame; one whose keyframe never settled stands relative to it.
  std::vector<TrajectoryPose> poses() const { return poses(T_world_keyframe_); }
  // The same with the keyframes elsewhere.
  std::vector<TrajectoryPose> poses(
      const std::map<std::uint64_t, Eigen::Isometry3d>& T_world_keyframes) const;

 private:
  std::vector<TrajectoryPose> frames_;  // relative to their anchors
  std::size_t questioned_ = 0;          // the last so many frames
  std::vector<std::uint64_t> anchors_;
  std::map<std::uint64_t, Eigen::Isometry3d> T_world_keyframe_;
};

}  // namespace sparsight
