#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "hal/calibration.h"
#include "hal/frame_source.h"
#include "slam/odometry_config.h"
#include "slam/tracked_frame.h"
#include "slam/tracking/arbitrated_tracker.h"
#include "slam/tracking_reference.h"

namespace sparsight {

// The first half of the odometry (Sec. IV-C, and the keyframe rules of Sec. IV-B2): every frame
// against the latest keyframe. It knows of the window only what the reference says, so that the
// window may work on, on its own thread, and its word be taken up whenever it comes. Thread-bound;
// track() is real-time-safe.
class TrackingStage {
 public:
  TrackingStage(const RigCalibration& calibration, const OdometryConfig& config);

  // `reference` is the newest there is; if it names another keyframe than the last did, tracking
  // moves over to it first. `out` is reused. finest_level, search_budget: see TrackingStart.
  void track(const SynchronizedFrame& frame, const TrackingReference& reference, TrackedFrame& out,
             int finest_level = 0, SearchBudget* search_budget = nullptr);
  // Sets aside, and touches, the memory that frames of the calibrated camera take.
  void prepare(TrackedFrame& out);

 private:
  void take_up(const TrackingReference& reference);
  void begin_submap(const TrackingReference& reference);
  FrameOutcome follow(const SynchronizedFrame& frame, const TrackingReference& reference,
                      const ImagePyramid& pyramid, int finest_level, SearchBudget* search_budget);
  void learn(const SynchronizedFrame& frame, const TrackingReference& reference,
             const TrackingResult& result, const TrackingStart& start);
  bool wants_keyframe(const SynchronizedFrame& frame, const TrackingReference& reference,
                      const FrameOutcome& outcome) const;
  // Decides whether tracking is in question, and whether it is lost.
  void judge(const SynchronizedFrame& frame, const TrackingResult& result);
  Eigen::Isometry3d predicted(HostTime exposure) const;

  RigCalibration calibration_;
  OdometryConfig config_;
  ArbitratedTracker tracker_;
  std::optional<std::uint64_t> reference_version_;
  std::optional<std::uint64_t> keyframe_;     // tracked against
  std::optional<std::uint64_t> handed_over_;  // became a keyframe; not considered by the window yet
  Brightness brightness_at_hand_over_;

  MotionModel motion_;
  Brightness brightness_;  // of the last tracked frame relative to the keyframe
  double start_error_px_ = std::numeric_limits<double>::infinity();
  double found_share_ = 0.0;  // of the last tracked frame
  // Since a frame was missed, or much less was found of it than of the one before, and none was
  // found as well after that: what is found then may be a look-alike.
  bool in_question_ = false;
  int questioned_ = 0;          // frames in a row
  double trusted_share_ = 0.0;  // found of the last frame that was not
  HostTime last_trusted_;       // its exposure, or the keyframe's if later
  bool lost_ = false;           // in question for too long
  std::uint32_t submap_ = 0;
  // A frame was where the velocity had led to expect it; before, a wrong first step would have
  // every right one refused.
  bool velocity_confirmed_ = false;
};

}  // namespace sparsight
