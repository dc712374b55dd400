#pragma once

#include <Eigen/Geometry>

#include "hal/calibration.h"
#include "hal/sweep.h"
#include "slam/lidar/sweep_arbiter.h"
#include "slam/tracking/tracker.h"

namespace sparsight {

// The tracker, and where the image leaves a doubt, the LiDAR's word. Cars that fill the image carry
// a camera's pose away; the sweep, which sees all around, lies on the keyframe's surface or does
// not. It proposes a start, and where it knows all six directions, it decides: between two poses
// that the image would have, or, if the image has found a tenth of what the keyframe shows, by
// itself. Thread-bound; after construction real-time-safe.
class ArbitratedTracker {
 public:
  ArbitratedTracker(const RigCalibration& calibration, const TrackerConfig& config,
                    const PhotometryConfig& photometry);

  void set_camera(const CameraModel& camera) { tracker_.set_camera(camera); }
  bool reachable(const Eigen::Isometry3d& T_keyframe_camera, const TrackingStart& start) const {
    return tracker_.reachable(T_keyframe_camera, start);
  }
  void rehearse_search(const ImagePyramid& image) { tracker_.rehearse_search(image); }

  // twist: of the camera, as it is expected during the sweep, [rad/s, m/s].
  TrackingResult track(const TrackingTarget& keyframe, const ImagePyramid& image,
                       const Sweep& sweep, const Vector6d& twist, const TrackingStart& start);

 private:
  // One direct attempt, and how much of the sweep lies on the keyframe's surface from there.
  struct Attempt {
    TrackingResult result;
    double share = 0.0;
    bool settled = false;
  };
  bool in_doubt(const Attempt& attempt) const { return !attempt.settled || in_traffic_ > 0; }
  bool contradicts(const SweepArbiter::Opinion& opinion, const Attempt& attempt) const;
  Attempt attempt(const TrackingTarget& keyframe, const ImagePyramid& image,
                  const TrackingStart& start, const TrackingStart& expected);
  Attempt attempt_at(const SweepArbiter::Opinion& opinion, bool decides,
                     const TrackingTarget& keyframe, const ImagePyramid& image,
                     const TrackingStart& start);
  Attempt arbitrate(const TrackingTarget& keyframe, const ImagePyramid& image,
                    const TrackingStart& start, const Attempt& first);

  bool asks_;
  bool searches_;
  Tracker tracker_;
  SweepArbiter arbiter_;
  double share_before_ = 0.0;  // of the last frame that was believed
  int in_traffic_ = 0;         // frames to come in which the image is not believed by itself
};

}  // namespace sparsight
