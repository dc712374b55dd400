#include "realtime/pipeline/anchored_trajectory.h"

namespace sparsight {

void AnchoredTrajectory::add(std::uint64_t sequence, HostTime exposure,
                             const FrameOutcome& outcome) {
  using Status = FrameOutcome::Status;
  frames_.push_back({.sequence = sequence,
                     .exposure = exposure,
                     .T_world_camera = outcome.tracking.T_keyframe_camera,
                     .known = outcome.status != Status::kLost});
  anchors_.push_back(outcome.keyframe_sequence);
  questioned_ = outcome.in_question ? questioned_ + 1 : 0;
  if (outcome.status != Status::kLost) return;
  for (; questioned_ > 0; --questioned_) frames_[frames_.size() - questioned_].known = false;
}

void AnchoredTrajectory::settle(std::uint64_t keyframe, const Eigen::Isometry3d& T_world_keyframe) {
  T_world_keyframe_[keyframe] = T_world_keyframe;
}

std::vector<TrajectoryPose> AnchoredTrajectory::poses(
    const std::map<std::uint64_t, Eigen::Isometry3d>& T_world_keyframes) const {
  std::vector<TrajectoryPose> result = frames_;
  Eigen::Isometry3d last_known = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < result.size(); ++i) {
    TrajectoryPose& pose = result[i];
    const auto own = T_world_keyframes.find(pose.sequence);
    const auto keyframe = T_world_keyframes.find(anchors_[i]);
    if (!pose.known && own != T_world_keyframes.end()) {  // with it a sub-map began
      pose.T_world_camera = own->second;
      pose.known = true;
    } else if (!pose.known) {
      pose.T_world_camera = last_known;
    } else if (keyframe != T_world_keyframes.end()) {
      pose.T_world_camera = keyframe->second * frames_[i].T_world_camera;
    }
    last_known = pose.T_world_camera;
  }
  return result;
}

}  // namespace sparsight
