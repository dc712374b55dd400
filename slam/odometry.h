#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "hal/frame_source.h"
#include "slam/calibration/self_calibration.h"
#include "slam/keyframe.h"
#include "slam/loop/loop_config.h"
#include "slam/points/point_selection.h"
#include "slam/tracking/tracker.h"
#include "slam/window/window_optimizer.h"

namespace sparsight {

// When a frame becomes a keyframe (Sec. IV-B2, Table I).
struct KeyframeConfig {
  double min_visible_ratio = 0.8;  // gamma_kf: below this share of projectable points
  double max_age_s = 1.0;          // t_kf
};

struct OdometryConfig {
  PointSelectionConfig points;
  PhotometryConfig photometry;
  TrackerConfig tracker;
  KeyframeConfig keyframes;
  WindowConfig window;
  SelfCalibrationConfig self_calibration;
  LoopConfig loop;  // of what follows the odometry; nothing in here depends on it
};

// A keyframe that has left the window: its pose is final for the odometry.
struct RetiredKeyframe {
  std::uint64_t sequence = 0;
  HostTime exposure;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  // What the window knew, when this keyframe left, about the next one relative to it.
  struct Successor {
    std::uint64_t sequence = 0;
    Eigen::Isometry3d T_keyframe_successor = Eigen::Isometry3d::Identity();
    Matrix6d information = Matrix6d::Zero();  // left perturbation of T_keyframe_successor
  };
  std::optional<Successor> successor;  // none for the last keyframe
  std::vector<CloudPoint> cloud_camera;
  ImagePyramid pyramid;
  bool predicted = false;  // where it stands relative to the one before was not measured
};

// What became of one frame. A frame that could not be tracked carries a predicted pose and says so.
struct FrameOutcome {
  enum class Status : std::uint8_t {
    kTracked,    // pose measured against a keyframe
    kFirst,      // defines the world frame
    kPredicted,  // not measured: no image, or tracking failed from every start
  };
  Status status = Status::kPredicted;
  TrackingResult tracking;  // of the best attempt; its pose is the predicted one if none
  std::uint64_t keyframe_sequence = 0;  // the keyframe T_keyframe_camera refers to
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();  // as known at that moment
  bool becomes_keyframe = false;
};

// The odometry of Secs. III and IV on one page. Thread-bound, deterministic, no clock, no file.
class Odometry {
 public:
  Odometry(const RigCalibration& calibration, const OdometryConfig& config);
  ~Odometry();

  // Tracks the frame against the latest keyframe. The real-time part.
  FrameOutcome track(const SynchronizedFrame& frame);
  // If track() said so: makes the frame a keyframe, optimises the window, marginalises the oldest.
  void add_keyframe(const SynchronizedFrame& frame);
  // The camera as it is believed to be now: as given, or as self-calibration has found it.
  const CameraIntrinsics& camera() const;
  // Keyframes that left the window since the last call, oldest first.
  std::vector<RetiredKeyframe> take_retired();
  // Empties the window at the end of a run: all remaining keyframes leave.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace sparsight
