#include "realtime/pipeline/deterministic_replay.h"

#include <map>

namespace sparsight {
namespace {

std::chrono::nanoseconds time_of(const std::function<void()>& stage) {
  const auto start = std::chrono::steady_clock::now();
  stage();
  return std::chrono::steady_clock::now() - start;
}

// Frames hang on keyframes; they are placed once their keyframe's pose is final.
class AnchoredTrajectory {
 public:
  void add(const SynchronizedFrame& frame, const FrameOutcome& outcome) {
    frames_.push_back({.sequence = frame.sequence,
                       .exposure = frame.exposure,
                       .T_world_camera = outcome.tracking.T_keyframe_camera});
    anchors_.push_back(outcome.keyframe_sequence);
  }
  void settle(const RetiredKeyframe& keyframe) {
    T_world_keyframe_[keyframe.sequence] = keyframe.T_world_camera;
  }
  std::vector<TrajectoryPose> poses() const { return poses(T_world_keyframe_); }
  std::vector<TrajectoryPose> poses(
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

 private:
  std::vector<TrajectoryPose> frames_;  // relative to their anchors
  std::vector<std::uint64_t> anchors_;
  std::map<std::uint64_t, Eigen::Isometry3d> T_world_keyframe_;
};

}  // namespace

ReplayTrajectories replay_deterministic(FrameSource& source, Odometry& odometry,
                                        std::optional<std::size_t> max_frames,
                                        const ReplayCallbacks& callbacks, LoopCloser* loops) {
  AnchoredTrajectory trajectory;
  const auto collect_retired = [&] {
    for (RetiredKeyframe& keyframe : odometry.take_retired()) {
      trajectory.settle(keyframe);
      if (loops != nullptr) loops->add(keyframe, odometry.camera());
      if (callbacks.on_keyframe) callbacks.on_keyframe(std::move(keyframe));
    }
  };

  std::size_t count = 0;
  while (!max_frames || count < *max_frames) {
    std::optional<SynchronizedFrame> frame = source.next();
    if (!frame) break;
    ++count;

    FrameRecord record{.sequence = frame->sequence, .exposure = frame->exposure};
    record.tracking_time = time_of([&] { record.outcome = odometry.track(*frame); });
    trajectory.add(*frame, record.outcome);
    if (record.outcome.becomes_keyframe) {
      record.window_time = time_of([&] { odometry.add_keyframe(*frame); });
    }
    collect_retired();
    record.faults = std::move(frame->faults);
    if (callbacks.on_frame) callbacks.on_frame(record);
  }
  odometry.finish();
  collect_retired();
  ReplayTrajectories result{.odometry = trajectory.poses()};
  if (loops != nullptr) {
    loops->finish();
    result.corrected_keyframes = loops->poses();
    result.corrected = trajectory.poses(result.corrected_keyframes);
  }
  return result;
}

}  // namespace sparsight
