#include "slam/tracking/tracker.h"

#include <algorithm>
#include <cmath>

#include "slam/tracking/patch_correlation.h"

namespace sparsight {

Tracker::Tracker(const CameraModel& camera, const TrackerConfig& config) : config_(config) {
  for (int level = 0; level < config.pyramid_levels; ++level) {
    cameras_.push_back(camera.at_level(level));
  }
}

TrackingResult Tracker::track_from(const Keyframe& keyframe, const ImagePyramid& image,
                                   const Eigen::Isometry3d& start_T_keyframe_camera,
                                   const Brightness& start_brightness, int top_level) {
  Alignment at;
  at.T_camera_keyframe = start_T_keyframe_camera.inverse();
  at.brightness = start_brightness;
  for (int level = top_level; level >= 0; --level) {
    const auto index = static_cast<std::size_t>(level);
    at = align(keyframe.patches[index], image.level(level), cameras_[index],
               keyframe.mean_inverse_depth, at, config_.alignment, workspace_);
  }

  const PatchAgreement agreement =
      patch_agreement(keyframe.patches.front(), workspace_.current, at.brightness);
  TrackingResult result;
  result.T_keyframe_camera = renormalized(at.T_camera_keyframe.inverse());
  result.information = at.information;
  result.brightness = at.brightness;
  result.points_used = agreement.visible_patches;
  result.visible_ratio =
      static_cast<double>(agreement.visible_patches) /
      std::max<double>(1.0, static_cast<double>(keyframe.patches.front().patches));
  result.residual_sigma_grey = at.sigma_grey;
  result.correlation = agreement.median_correlation;
  result.top_level = top_level;
  using Status = TrackingResult::Status;
  if (agreement.visible_patches < config_.min_points) {
    result.status = Status::kTooFewPoints;
  } else if (agreement.median_correlation < config_.min_correlation ||
             !result.T_keyframe_camera.matrix().allFinite()) {
    result.status = Status::kDiverged;
  } else {
    result.status = at.converged ? Status::kConverged : Status::kIterationLimit;
  }
  return result;
}

TrackingResult Tracker::track(const Keyframe& keyframe, const ImagePyramid& image,
                              const std::vector<Eigen::Isometry3d>& starts_T_keyframe_camera,
                              const Brightness& start_brightness, double start_error_px) {
  const int coarsest =
      std::min({config_.pyramid_levels, image.levels(), static_cast<int>(keyframe.patches.size())}) -
      1;
  int top = coarsest;
  if (config_.automatic_top_level) {
    top = std::clamp(static_cast<int>(std::ceil(std::log2(std::max(start_error_px, 1.0)))), 0,
                     coarsest);
  }
  TrackingResult best;
  int attempts = 0;
  for (const Eigen::Isometry3d& start : starts_T_keyframe_camera) {
    TrackingResult result = track_from(keyframe, image, start, start_brightness, top);
    result.attempts = ++attempts;
    if (attempts == 1 || result.correlation > best.correlation) best = result;
    if (result.ok() || !config_.try_other_starts) break;
    top = coarsest;  // the first start was wrong, or this would not be the second
  }
  best.attempts = attempts;
  return best;
}

}  // namespace sparsight
