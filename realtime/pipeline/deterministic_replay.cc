#include "realtime/pipeline/deterministic_replay.h"

#include "realtime/pipeline/anchored_trajectory.h"

namespace sparsight {
namespace {

std::chrono::nanoseconds time_of(const std::function<void()>& stage) {
  const auto start = std::chrono::steady_clock::now();
  stage();
  return std::chrono::steady_clock::now() - start;
}

}  // namespace

ReplayTrajectories replay_deterministic(FrameSource& source, Odometry& odometry,
                                        std::optional<std::size_t> max_frames,
                                        const ReplayCallbacks& callbacks, LoopCloser* loops) {
  AnchoredTrajectory trajectory;
  const auto collect_retired = [&] {
    for (RetiredKeyframe& keyframe : odometry.take_retired()) {
      trajectory.settle(keyframe.sequence, keyframe.T_world_camera);
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
    trajectory.add(frame->sequence, frame->exposure, record.outcome);
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
    result.placed = loops->placed_keyframes();
    result.corrected = trajectory.poses(loops->poses());
  }
  return result;
}

}  // namespace sparsight
