#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hal/calibration.h"
#include "hal/frame_source.h"
#include "slam/odometry_config.h"
#include "slam/retired_keyframe.h"
#include "slam/tracked_frame.h"
#include "slam/tracking_reference.h"

namespace sparsight {

// The second half of the odometry (Secs. IV-B and IV-D): makes keyframes, optimises the window,
// learns the camera, and lets the oldest keyframe go. Thread-bound.
class WindowStage {
 public:
  WindowStage(const RigCalibration& calibration, const OdometryConfig& config);

  // Makes the frame a keyframe, posed as it was tracked. False if it has too few points to be one.
  // With a frame that was lost a sub-map begins: nothing ties it to the keyframes before, which all
  // leave.
  bool accept(const SynchronizedFrame& frame, const TrackedFrame& tracked);
  // Optimises, learns, and marginalises the oldest keyframe of a full window. most_iterations: in
  // want of time, fewer than configured.
  void optimize(std::optional<int> most_iterations = std::nullopt);
  // What tracking is to know of it now.
  void describe(TrackingReference& out);

  // The camera as it is believed to be now: as given, or as self-calibration has found it.
  const CameraIntrinsics& camera() const { return camera_.intrinsics(); }
  // Keyframes that left the window since the last call, oldest first.
  std::vector<RetiredKeyframe> take_retired();
  // Empties the window, at the end of a run or of a sub-map: all remaining keyframes leave.
  void finish();

 private:
  std::unique_ptr<Keyframe> make_keyframe(const SynchronizedFrame& frame,
                                          const TrackedFrame& tracked);
  PatchSet patches_of(const Keyframe& keyframe, int level) const;
  Eigen::Isometry3d pose_of(const TrackedFrame& tracked);
  void retire_oldest();

  RigCalibration calibration_;
  OdometryConfig config_;
  CameraModel camera_;
  WindowOptimizer window_;
  SelfCalibration self_calibration_;
  bool other_camera_ = false;  // it has learned of one
  std::optional<std::uint64_t> considered_;
  std::uint64_t version_ = 0;
  std::uint32_t submap_ = 0;
  std::vector<RetiredKeyframe> retired_;
};

}  // namespace sparsight
