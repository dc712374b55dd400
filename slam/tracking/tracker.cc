#include "slam/tracking/tracker.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "slam/tracking/patch_correlation.h"
#include "slam/tracking/starting_motions.h"

namespace sparsight {
namespace {

// The search ranks the starts by so many patches of the coarsest level, takes the most promising to
// that level's minimum, and follows to the finest those that lead to different places and are not
// clearly worse than the best.
constexpr std::size_t kRankedPatches = 100;
constexpr std::size_t kExamined = 6;
constexpr int kFollowed = 3;
constexpr double kSamePlacePx = 2.0;  // at the coarsest level
constexpr double kHopeless = 0.1;     // of correlation

Alignment start_at(const Eigen::Isometry3d& T_keyframe_camera, const Brightness& brightness) {
  Alignment at;
  at.T_camera_keyframe = T_keyframe_camera.inverse();
  at.brightness = brightness;
  return at;
}

// Poses that were followed already.
class VisitedPlaces {
 public:
  VisitedPlaces(const CameraModel& camera, double mean_inverse_depth)
      : focal_px_(camera.intrinsics().fx), mean_inverse_depth_(mean_inverse_depth) {}

  // False if the pose is one of them.
  bool add(const Eigen::Isometry3d& T_camera_keyframe) {
    for (const Eigen::Isometry3d& place : places_) {
      if (distance_px(place, T_camera_keyframe) < kSamePlacePx) return false;
    }
    places_.push_back(T_camera_keyframe);
    return true;
  }

 private:
  // Upper bound of how far apart the two see a point at mean depth.
  double distance_px(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const {
    const Vector6d d = log_se3(a * b.inverse());
    return focal_px_ * (d.head<3>().norm() + d.tail<3>().norm() * mean_inverse_depth_);
  }

  double focal_px_;
  double mean_inverse_depth_;
  std::vector<Eigen::Isometry3d> places_;
};

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
    // Far from the pose nearly every patch disagrees as a whole: no ground to judge patches on.
    PhotometryConfig photometry = photometry_;
    photometry.patch_weights = photometry_.patch_weights && level == 0;
    at = align(keyframe.patches[index], image.level(level), cameras_[index],
               keyframe.mean_inverse_depth, at, config_.alignment, photometry, workspace_);
  }
  return at;
}

bool Tracker::plausible(const Eigen::Isometry3d& T_keyframe_camera,
                        const TrackingStart& start) const {
  if (!T_keyframe_camera.matrix().allFinite()) return false;
  if (!start.seconds_since_previous) return true;
  const double seconds = *start.seconds_since_previous;
  const double surprise_m =
      (T_keyframe_camera.translation() - start.T_keyframe_predicted.translation()).norm();
  return surprise_m <= config_.max_acceleration_m_s2 * seconds * seconds;
}

TrackingResult Tracker::verdict(const Keyframe& keyframe, const Alignment& at,
                                const TrackingStart& start, int top_level) const {
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
             !plausible(result.T_keyframe_camera, start)) {
    result.status = Status::kDiverged;
  } else {
    result.status = at.converged ? Status::kConverged : Status::kIterationLimit;
  }
  return result;
}

std::vector<RankedStart> Tracker::ranked_starts(const Keyframe& keyframe, const ImagePyramid& image,
                                                const TrackingStart& start, int coarsest) {
  const auto level = static_cast<std::size_t>(coarsest);
  std::vector<Alignment> starts;
  const double mean_depth_m = 1.0 / std::max(keyframe.mean_inverse_depth, 1e-3);
  for (const Eigen::Isometry3d& T_keyframe_camera :
       starting_motions(start.T_keyframe_previous, start.T_keyframe_predicted, mean_depth_m)) {
    starts.push_back(start_at(T_keyframe_camera, start.brightness));
  }
  const PatchSet& patches = keyframe.patches[level];
  const PatchSet sample = thinned(patches, kRankedPatches);
  const double share = static_cast<double>(sample.patches) /
                       static_cast<double>(std::max<std::size_t>(1, patches.patches));
  return rank_starts(starts, sample, image.level(coarsest), cameras_[level],
                     keyframe.mean_inverse_depth, share * config_.min_points, photometry_,
                     workspace_);
}

TrackingResult Tracker::search(const Keyframe& keyframe, const ImagePyramid& image,
                               const TrackingStart& start, int coarsest,
                               const TrackingResult& direct) {
  const std::vector<RankedStart> ranked = ranked_starts(keyframe, image, start, coarsest);
  // Many starts meet in one place, most often where the direct attempt has ended.
  VisitedPlaces places(cameras_[static_cast<std::size_t>(coarsest)], keyframe.mean_inverse_depth);
  if (direct.ok()) places.add(direct.T_keyframe_camera.inverse());
  TrackingResult best;
  int followed = 0;
  for (std::size_t i = 0; i < std::min(ranked.size(), kExamined) && followed < kFollowed; ++i) {
    if (ranked[i].correlation < ranked.front().correlation - kHopeless) break;
    const Alignment coarse = refine(keyframe, image, ranked[i].at, coarsest, coarsest);
    if (!places.add(coarse.T_camera_keyframe)) continue;
    ++followed;
    const TrackingResult result =
        verdict(keyframe, refine(keyframe, image, coarse, coarsest - 1, 0), start, coarsest);
    if (result.ok() >= best.ok() && result.correlation > best.correlation) best = result;
  }
  best.attempts = static_cast<int>(ranked.size());
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
  Alignment predicted = start_at(start.T_keyframe_predicted, start.brightness);
  if (config_.max_sigma_growth > 0.0 && known && top <= 1) {
    predicted.sigma_limit_grey = config_.max_sigma_growth * start.sigma_grey;
  }
  TrackingResult result = verdict(keyframe, refine(keyframe, image, predicted, top, 0), start, top);
  result.attempts = 1;
  if (!config_.try_other_starts || (known && result.ok())) return result;

  TrackingResult searched = search(keyframe, image, start, levels - 1, result);
  searched.attempts += result.attempts;
  return searched.ok() >= result.ok() && searched.correlation > result.correlation ? searched
                                                                                   : result;
}

}  // namespace sparsight
