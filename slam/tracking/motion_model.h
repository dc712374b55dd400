#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <optional>

#include "hal/time.h"
#include "slam/geometry/se3.h"

namespace sparsight {

// The constant-motion model of Sec. III: where the camera should be now, from where it was. Copied
// without allocating; real-time-safe.
class MotionModel {
 public:
  // The frame at `exposure` stands at T_keyframe_camera of the current keyframe. A pose in doubt
  // leaves a velocity that is known as it was.
  void observe(HostTime exposure, const Eigen::Isometry3d& T_keyframe_camera,
               bool in_doubt = false);
  // The frame at `exposure` is the keyframe from now on, whether or not it was observed, and
  // whether or not frames after it were.
  void rebase(HostTime exposure);
  // The frame at `exposure` is the keyframe from now on, and nothing is known of what was before.
  void restart(HostTime exposure);

  // Camera-frame velocity [rad/s, m/s]; nothing before two frames were observed.
  const std::optional<Vector6d>& twist() const { return twist_; }
  const Eigen::Isometry3d& last_in_keyframe() const { return T_keyframe_last_; }
  // Nothing before the velocity is known.
  std::optional<double> seconds_since_last(HostTime exposure) const;
  Eigen::Isometry3d predict_in_keyframe(HostTime exposure) const;
  // Where the camera was at a time near the last frames: between two of them as they stand, beyond
  // them by the velocity.
  Eigen::Isometry3d at(HostTime time) const;

 private:
  struct Observed {
    HostTime exposure;
    Eigen::Isometry3d T_keyframe_camera;
  };
  // A revolution of a LiDAR at 5 Hz, seen by a camera at 60 Hz.
  static constexpr std::size_t kRemembered = 13;

  std::array<Observed, kRemembered> recent_;  // the first count_ of them, oldest first
  std::size_t count_ = 0;
  std::optional<HostTime> last_exposure_;
  Eigen::Isometry3d T_keyframe_last_ = Eigen::Isometry3d::Identity();
  std::optional<Vector6d> twist_;
};

}  // namespace sparsight
