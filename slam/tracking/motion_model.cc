#include "slam/tracking/motion_model.h"

namespace sparsight {

void MotionModel::observe(HostTime exposure, const Eigen::Isometry3d& T_keyframe_camera) {
  if (last_exposure_ && exposure > *last_exposure_) {
    const double seconds = to_seconds(exposure - *last_exposure_);
    twist_ = log_se3(T_keyframe_last_.inverse() * T_keyframe_camera) / seconds;
  }
  last_exposure_ = exposure;
  T_keyframe_last_ = T_keyframe_camera;
}

void MotionModel::rebase(HostTime exposure) {
  last_exposure_ = exposure;
  T_keyframe_last_ = Eigen::Isometry3d::Identity();
}

std::optional<double> MotionModel::seconds_since_last(HostTime exposure) const {
  if (!twist_ || !last_exposure_) return std::nullopt;
  return to_seconds(exposure - *last_exposure_);
}

Eigen::Isometry3d MotionModel::predict_in_keyframe(HostTime exposure) const {
  if (!twist_ || !last_exposure_) return T_keyframe_last_;
  return T_keyframe_last_ * exp_se3(*twist_ * to_seconds(exposure - *last_exposure_));
}

}  // namespace sparsight
