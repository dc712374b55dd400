#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "hal/frame_source.h"
#include "realtime/pipeline/frame_record.h"
#include "slam/odometry.h"

namespace sparsight {

struct ReplayCallbacks {
  std::function<void(const FrameRecord&)> on_frame;
  std::function<void(RetiredKeyframe&&)> on_keyframe;
};

// Runs the stages on one schedule, without threads or a wall clock: the same frames give the same
// bytes. Returns one pose per frame, each re-anchored to the final pose of its keyframe.
// max_frames: stop early.
std::vector<TrajectoryPose> replay_deterministic(FrameSource& source, Odometry& odometry,
                                                 std::optional<std::size_t> max_frames,
                                                 const ReplayCallbacks& callbacks);

}  // namespace sparsight
