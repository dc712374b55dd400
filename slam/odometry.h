#pragma once

#include <vector>

#include "hal/frame_source.h"
#include "slam/tracking_stage.h"
#include "slam/window_stage.h"

namespace sparsight {

// The odometry of Secs. III and IV on one page: its two stages on one schedule, in which the window
// has always done its work before the next frame comes. (The live rig runs the same stages on
// threads of their own, see realtime/pipeline.) Thread-bound, deterministic, no clock, no file.
class Odometry {
 public:
  Odometry(const RigCalibration& calibration, const OdometryConfig& config);

  // Tracks the frame against the latest keyframe. The real-time part.
  FrameOutcome track(const SynchronizedFrame& frame);
  // If track() said so: makes the frame a keyframe, optimises the window, marginalises the oldest.
  void add_keyframe(const SynchronizedFrame& frame);
  const CameraIntrinsics& camera() const { return window_.camera(); }
  std::vector<RetiredKeyframe> take_retired() { return window_.take_retired(); }
  void finish() { window_.finish(); }

 private:
  TrackingStage tracking_;
  WindowStage window_;
  TrackingReference reference_;
  TrackedFrame tracked_;
};

}  // namespace sparsight
