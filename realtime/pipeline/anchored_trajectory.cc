#include "realtime/pipeline/anchored_trajectory.h"

namespace sparsight {

void AnchoredTrajectory::add(std::uint64_t sequence, HostTime exposure,
                             const FrameOutcome& outcome) {
  frames_.push_back({.sequence = sequence,
                     .exposure = exposure,
                     .T_world_camera = outcome.tracking.T_keyframe_camera});
  anchors_.push_back(outcome.keyframe_sequence);
}

void AnchoredTrajectory::settle(std::uint64_t keyframe, const Eigen::Isometry3d& T_world_keyframe) {
  T_world_keyframe_[keyframe] = T_world_keyframe;
}

std::vector<TrajectoryPose> AnchoredTrajectory::poses(
    const std::map<std::uint64_t, Eigen::Isometry3d>& T_world_keyframes) const {
  std::vector<TrajectoryPose> result = frames_;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const auto keyframe = T_world_keyframes.find(anchors_[i]);
    if (keyframe != T_world_keyframes.end()) {
      result[i].T_world_camera = keyframe->second * frames_[i].T_world_camera;
    }
  }
  return result;
}

}  // namespace sparsight
