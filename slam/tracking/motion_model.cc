#include "slam/tracking/motion_model.h"

#include <algorithm>

namespace sparsight {

void MotionModel::observe(HostTime exposure, const Eigen::Isometry3d& T_keyframe_camera,
                          bool in_doubt) {
  const bool learns = !in_doubt || !twist_;
  if (learns && last_exposure_ && exposure > *last_exposure_) {
    const double seconds = to_seconds(exposure - *last_exposure_);
    twist_ = log_se3(T_keyframe_last_.inverse() * T_keyframe_camera) / seconds;
  }
  last_exposure_ = exposure;
  T_keyframe_last_ = T_keyframe_camera;
  if (count_ == kRemembered) {
    std::move(recent_.begin() + 1, recent_.end(), recent_.begin());
    --count_;
  }
  recent_[count_++] = {exposure, T_keyframe_camera};
}

void MotionModel::rebase(HostTime exposure) {
  const Eigen::Isometry3d T_new_old = at(exposure).inverse();
  for (std::size_t i = 0; i < count_; ++i) {
    recent_[i].T_keyframe_camera = T_new_old * recent_[i].T_keyframe_camera;
  }
  if (last_exposure_ && *last_exposure_ > exposure) {
    T_keyframe_last_ = T_new_old * T_keyframe_last_;
    return;
  }
  last_exposure_ = exposure;
  T_keyframe_last_ = Eigen::Isometry3d::Identity();
}

void MotionModel::restart(HostTime exposure) {
  *this = {};
  observe(exposure, Eigen::Isometry3d::Identity());
}

Eigen::Isometry3d MotionModel::at(HostTime time) const {
  const auto end = recent_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto after =
      std::find_if(recent_.begin(), end, [&](const Observed& o) { return o.exposure >= time; });
  if (after == end || after == recent_.begin()) {
    if (count_ == 0) return predict_in_keyframe(time);
    const Observed& nearest = after == end ? recent_[count_ - 1] : recent_.front();
    const Vector6d twist = twist_.value_or(Vector6d::Zero());
    return nearest.T_keyframe_camera * exp_se3(twist * to_seconds(time - nearest.exposure));
  }
  const Observed& a = *(after - 1);
  const double share = to_seconds(time - a.exposure) / to_seconds(after->exposure - a.exposure);
  return a.T_keyframe_camera *
         exp_se3(share * log_se3(a.T_keyframe_camera.inverse() * after->T_keyframe_camera));
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
