#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "hal/frame_source.h"
#include "realtime/pipeline/frame_record.h"
#include "slam/loop/loop_closer.h"
#include "slam/odometry.h"

namespace sparsight {

struct ReplayCallbacks {
  std::function<void(const FrameRecord&)> on_frame;
  std::function<void(RetiredKeyframe&&)> on_keyframe;
};

// One pose per frame, each re-anchored to the final pose of its keyframe.
struct ReplayTrajectories {
  std::vector<TrajectoryPose> odometry;   // as the keyframes left the window
  std::vector<TrajectoryPose> corrected;  // as the pose graph has them; empty without a LoopCloser
  std::vector<PlacedKeyframe> placed;     // likewise, with where their clouds are
};

// Runs the stages on one schedule, without threads or a wall clock: the same frames give the same
// bytes. max_frames: stop early. loops: closes them, if not null.
ReplayTrajectories replay_deterministic(FrameSource& source, Odometry& odometry,
                                        std::optional<std::size_t> max_frames,
                                        const ReplayCallbacks& callbacks,
                                        LoopCloser* loops = nullptr);

}  // namespace sparsight
