#include "slam/tracking/tracker.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "slam/tracking/patch_correlation.h"
#include "slam/tracking/starting_motions.h"

namespace sparsight {
namespace {

// After the search at the coarsest level, so many of the best are followed to the finest.
constexpr std::size_t kFollowed = 3;

Alignment start_at(const Eigen::Isometry3d& T_keyframe_camera, const Brightness& brightness) {
  Alignment at;
  at.T_camera_keyframe = T_keyframe_camera.inverse();
  at.brightness = brightness;
  return at;
}

}  // namespace

Tracker::Tracker(const CameraModel& camera, const TrackerConfig& config,
                 const PhotometryConfig& photometry)
    : config_(config), photometry_(photometry) {
  for (int level = 0; level < config.pyramid_levels; ++level) {
    cameras_.push_back(camera.at_level(level));
  }
}

Alignment Tracker::refine(const Keyframe& keyframe, const ImagePyramid& image,
                          const Alignment& start, int coarsest, int finest) {
  Alignment at = start;
  for (int level = coarsest; level >= finest; --level) {
    const auto index = static_cast<std::size_t>(level);
    at = align(keyframe.patches[index], image.level(level), cameras_[index],
               keyframe.mean_inverse_depth, at, config_.alignment, photometry_, workspace_);
  }
  return at;
}

TrackingResult Tracker::verdict(const Keyframe& keyframe, const Alignment& at,
                                int top_level) const {
  const PatchSet& finest = keyframe.patches.front();
  const PatchAgreement agreement = patch_agreement(finest, workspace_.current, at.brightness);
  TrackingResult result;
  result.T_keyframe_camera = renormalized(at.T_camera_keyframe.inverse());
  result.information = at.information;
  result.brightness = at.brightness;
  result.points_used = agreement.visible_patches;
  result.visible_ratio = static_cast<double>(agreement.visible_patches) /
                         std::max(1.0, static_cast<double>(finest.patches));
  result.residual_sigma_grey = at.sigma_grey;
  result.correlation = agreement.median_correlation;
  result.top_level = top_level;
  using Status = TrackingResult::Status;
  if (agreement.visible_patches < config_.min_points) {
    result.status = Status::kTooFewPoints;
  } else if (!(agreement.median_correlation >= config_.min_correlation) ||
             !result.T_keyframe_camera.matrix().allFinite()) {
    result.status = Status::kDiverged;
  } else {
    result.status = at.converged ? Status::kConverged : Status::kIterationLimit;
  }
  return result;
}

TrackingResult Tracker::search(const Keyframe& keyframe, const ImagePyramid& image,
                               const TrackingStart& start, int coarsest) {
  const double mean_depth_m = 1.0 / std::max(keyframe.mean_inverse_depth, 1e-3);
  std::vector<std::pair<double, Alignment>> coarse;  // by disagreement
  const PatchSet& patches = keyframe.patches[static_cast<std::size_t>(coarsest)];
  for (const Eigen::Isometry3d& T_keyframe_camera :
       starting_motions(start.T_keyframe_previous, start.T_keyframe_predicted, mean_depth_m)) {
    const Alignment at =
        refine(keyframe, image, start_at(T_keyframe_camera, start.brightness), coarsest, coarsest);
    const PatchAgreement agreement = patch_agreement(patches, workspace_.current, at.brightness);
    if (agreement.visible_patches < config_.min_points) continue;
    coarse.emplace_back(-agreement.median_correlation, at);
  }
  std::stable_sort(coarse.begin(), coarse.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  TrackingResult best;
  for (std::size_t i = 0; i < std::min(coarse.size(), kFollowed); ++i) {
    const Alignment at = refine(keyframe, image, coarse[i].second, coarsest - 1, 0);
    const TrackingResult result = verdict(keyframe, at, coarsest);
    if (result.ok() >= best.ok() && result.correlation > best.correlation) best = result;
  }
  best.attempts = static_cast<int>(coarse.size());
  return best;
}

TrackingResult Tracker::track(const Keyframe& keyframe, const ImagePyramid& image,
                              const TrackingStart& start) {
  const int levels =
      std::min({config_.pyramid_levels, image.levels(), static_cast<int>(keyframe.patches.size())});
  const bool known = std::isfinite(start.error_px);
  int top = levels - 1;
  if (config_.automatic_top_level && known) {
    // A start within about a pixel is within reach of the linearisation.
    top = std::clamp(static_cast<int>(std::ceil(std::log2(std::max(start.error_px, 1.0)))), 0, top);
  }
  const Alignment at =
      refine(keyframe, image, start_at(start.T_keyframe_predicted, start.brightness), top, 0);
  TrackingResult result = verdict(keyframe, at, top);
  result.attempts = 1;
  if (!config_.try_other_starts || (known && result.ok())) return result;

  TrackingResult searched = search(keyframe, image, start, levels - 1);
  searched.attempts += result.attempts;
  return searched.ok() >= result.ok() && searched.correlation > result.correlation ? searched
                                                                                   : result;
}

}  // namespace sparsight
