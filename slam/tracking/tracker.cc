#include "slam/tracking/tracker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "slam/tracking/patch_agreement.h"
#include "slam/tracking/speed_scan.h"
#include "slam/tracking/starting_motions.h"

namespace sparsight {
namespace {

// The search ranks the starts by so many patches of the coarsest level, takes the most promising to
// that level's minimum, and follows to the finest those that lead to different places and are not
// clearly worse than the best.
constexpr std::size_t kRankedPatches = 100;
constexpr std::size_t kExamined = 12;
constexpr int kFollowed = 4;
constexpr double kSamePlacePx = 2.0;  // at the coarsest level
constexpr double kHopeless = 0.25;    // of the share found

// Memory is set aside for keyframes of so many patches: a bin of 2 degrees each, as wide as a lens
// without distortion sees. More are tracked too, after an allocation.
constexpr std::size_t kMostPatches = 4096;

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

  bool know(const Eigen::Isometry3d& T_camera_keyframe) const {
    return std::any_of(places_.begin(), places_.begin() + count_, [&](const auto& place) {
      return distance_px(place, T_camera_keyframe) < kSamePlacePx;
    });
  }
  void add(const Eigen::Isometry3d& T_camera_keyframe) { places_[count_++] = T_camera_keyframe; }

 private:
  // Upper bound of how far apart the two see a point at mean depth.
  double distance_px(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const {
    const Vector6d d = log_se3(a * b.inverse());
    return focal_px_ * (d.head<3>().norm() + d.tail<3>().norm() * mean_inverse_depth_);
  }

  double focal_px_;
  double mean_inverse_depth_;
  std::array<Eigen::Isometry3d, 1 + kExamined> places_;  // the direct attempt's, and those examined
  std::size_t count_ = 0;
};

// A start that finds more than this share of the patches is as good as right.
constexpr double kFoundAtStart = 0.4;
constexpr double kDoubtful = 0.6;
// No other minimum finds so much: on fast roads the wrong ones find up to 0.7.
constexpr double kBeyondDoubt = 0.8;

// Refinement goes down by a level at least.
TrackingStart within(TrackingStart start, int coarsest) {
  start.finest_level = std::clamp(start.finest_level, 0, std::max(0, coarsest - 1));
  return start;
}

PhotometryConfig per_pixel(PhotometryConfig photometry) {
  photometry.patch_weights = false;
  return photometry;
}

}  // namespace

Tracker::Tracker(const CameraModel& camera, const TrackerConfig& config,
                 const PhotometryConfig& photometry)
    : config_(config), photometry_(photometry) {
  cameras_.reserve(static_cast<std::size_t>(std::max(0, config.pyramid_levels)));
  set_camera(camera);
  workspace_.reserve(kMostPatches * kPatternSize);
  search_.starts.reserve(kStartingMotions);
  search_.ranked.reserve(kStartingMotions);
  for (std::vector<float>* column : {&search_.sample.x, &search_.sample.y, &search_.sample.z,
                                     &search_.sample.intensity, &search_.sample.weight}) {
    column->resize(2 * kRankedPatches * kPatternSize + PatchSet::kBlock);
  }
}

void Tracker::set_camera(const CameraModel& camera) {
  cameras_.clear();
  for (int level = 0; level < config_.pyramid_levels; ++level) {
    cameras_.push_back(camera.at_level(level));
  }
}

void Tracker::rehearse_search(const ImagePyramid& image) {
  const int levels = std::min(config_.pyramid_levels, image.levels());
  if (levels == 0) return;
  const CameraIntrinsics& c = cameras_.front().intrinsics();
  const std::vector<SelectedPoint> wall(
      static_cast<std::size_t>(config_.min_points),
      {.p_camera = Eigen::Vector3f::UnitZ(), .pixel = Eigen::Vector2d(c.cx, c.cy).cast<float>()});
  TrackingTarget ahead{.mean_inverse_depth = 1.0};
  for (int level = 0; level < levels; ++level) {
    ahead.patches.push_back(make_patches(image, level, cameras_.front(), wall, 0.0));
  }
  from_everywhere(ahead, image, {}, levels - 1, {});
}

Alignment Tracker::refine(const TrackingTarget& keyframe, const ImagePyramid& image,
                          const Alignment& start, int coarsest, int finest,
                          const PhotometryConfig& photometry) {
  Alignment at = start;
  for (int level = coarsest; level >= finest; --level) {
    const auto index = static_cast<std::size_t>(level);
    at = align(keyframe.patches[index], image.level(level), cameras_[index],
               keyframe.mean_inverse_depth, at, config_.alignment, photometry, workspace_,
               level == finest ? Information::kTold : Information::kLeftOut);
  }
  return at;
}

// The prediction or, as a rig often stands still, the last pose: whichever already sees the
// keyframe at the finer level. A linearisation reaches about a pixel, and a patch that is a pixel
// off is not found; where neither is found the error that predictions had lately tells the level.
Tracker::Entry Tracker::entry(const TrackingTarget& keyframe, const ImagePyramid& image,
                              const TrackingStart& start, int coarsest) {
  Entry best{.at = start_at(start.T_keyframe_predicted, start.brightness), .level = coarsest};
  if (!config_.automatic_top_level || !std::isfinite(start.error_px)) return best;
  for (int level = start.finest_level; level <= coarsest && !best.found; ++level) {
    const auto index = static_cast<std::size_t>(level);
    double best_share = kFoundAtStart;
    for (const Eigen::Isometry3d& T : {start.T_keyframe_predicted, start.T_keyframe_previous}) {
      if (!reachable(T, start)) continue;
      const Alignment at = assess(keyframe.patches[index], image.level(level), cameras_[index],
                                  start_at(T, start.brightness), photometry_, workspace_);
      const PatchAgreement agreement =
          patch_agreement(keyframe.patches[index], workspace_.current, at.brightness);
      if (agreement.visible_patches < config_.min_points) continue;
      if (agreement.found_share <= best_share) continue;
      best_share = agreement.found_share;
      best = {.at = start_at(T, start.brightness), .level = level, .found = true};
    }
  }
  if (!best.found) {
    best.level = std::clamp(static_cast<int>(std::ceil(std::log2(std::max(start.error_px, 1.0)))),
                            start.finest_level, coarsest);
  }
  return best;
}

// Far from the pose nearly every patch disagrees as a whole, and there is no ground to judge
// patches on before the finest level.
Alignment Tracker::descend(const TrackingTarget& keyframe, const ImagePyramid& image,
                           const Alignment& start, int coarsest, int finest) {
  const Alignment near =
      refine(keyframe, image, start, coarsest, finest + 1, per_pixel(photometry_));
  return refine(keyframe, image, near, finest, finest, photometry_);
}

Alignment Tracker::past_other_minima(const TrackingTarget& keyframe, const ImagePyramid& image,
                                     const Alignment& found, const TrackingStart& start) {
  const int level = start.finest_level;
  const auto index = static_cast<std::size_t>(level);
  const PatchSet& patches = keyframe.patches[index];
  const Eigen::Vector3d way =
      start.T_keyframe_predicted.translation() - start.T_keyframe_previous.translation();
  const std::optional<Alignment> other = best_speed(
      patches, image.level(level), cameras_[index], keyframe.mean_inverse_depth, found, way,
      [&](const Eigen::Isometry3d& T) { return reachable(T, start); }, photometry_, workspace_);
  if (other) {
    Alignment refined = refine(keyframe, image, *other, level, level, photometry_);
    if (refined.cost < found.cost) return refined;
  }
  assess(patches, image.level(level), cameras_[index], found, photometry_, workspace_);
  return found;
}

bool Tracker::reachable(const Eigen::Isometry3d& T_keyframe_camera,
                        const TrackingStart& start) const {
  if (!T_keyframe_camera.matrix().allFinite()) return false;
  if (!start.seconds_since_previous) return true;
  const double seconds = *start.seconds_since_previous;
  const double surprise_m =
      (T_keyframe_camera.translation() - start.T_keyframe_predicted.translation()).norm();
  return surprise_m <= config_.max_acceleration_m_s2 * seconds * seconds;
}

TrackingResult Tracker::verdict(const TrackingTarget& keyframe, const Alignment& at,
                                const TrackingStart& start, int top_level) const {
  const PatchSet& finest = keyframe.patches[static_cast<std::size_t>(start.finest_level)];
  const PatchAgreement agreement = patch_agreement(finest, workspace_.current, at.brightness);
  TrackingResult result;
  result.T_keyframe_camera = renormalized(at.T_camera_keyframe.inverse());
  result.information = at.information;
  result.brightness = at.brightness;
  result.points_used = agreement.visible_patches;
  result.visible_ratio = static_cast<double>(agreement.visible_patches) /
                         std::max(1.0, static_cast<double>(finest.patches));
  result.residual_sigma_grey = at.sigma_grey;
  result.found_share = agreement.found_share;
  result.top_level = top_level;
  using Status = TrackingResult::Status;
  if (agreement.visible_patches < config_.min_points) {
    result.status = Status::kTooFewPoints;
  } else if (!(agreement.found_share >= config_.min_found_share) ||
             !reachable(result.T_keyframe_camera, start)) {
    result.status = Status::kDiverged;
  } else {
    result.status = at.converged ? Status::kConverged : Status::kIterationLimit;
  }
  return result;
}

const std::vector<RankedStart>& Tracker::ranked_starts(const TrackingTarget& keyframe,
                                                       const ImagePyramid& image,
                                                       const TrackingStart& start, int coarsest) {
  const auto level = static_cast<std::size_t>(coarsest);
  search_.starts.clear();
  const double mean_depth_m = 1.0 / std::max(keyframe.mean_inverse_depth, 1e-3);
  for (const Eigen::Isometry3d& T_keyframe_camera :
       starting_motions(start.T_keyframe_previous, start.T_keyframe_predicted, mean_depth_m)) {
    search_.starts.push_back(start_at(T_keyframe_camera, start.brightness));
  }
  const PatchSet& patches = keyframe.patches[level];
  thin(patches, kRankedPatches, search_.sample);
  const double share = static_cast<double>(search_.sample.patches) /
                       static_cast<double>(std::max<std::size_t>(1, patches.patches));
  rank_starts(search_.starts, search_.sample, image.level(coarsest), cameras_[level],
              keyframe.mean_inverse_depth, share * config_.min_points, per_pixel(photometry_),
              workspace_, search_.ranked, start.search_budget);
  return search_.ranked;
}

TrackingResult Tracker::from_everywhere(const TrackingTarget& keyframe, const ImagePyramid& image,
                                        const TrackingStart& start, int coarsest,
                                        const TrackingResult& direct) {
  const std::vector<RankedStart>& ranked = ranked_starts(keyframe, image, start, coarsest);
  // Many starts meet in one place, most often where the direct attempt has ended; ranking has shown
  // nearly where.
  VisitedPlaces places(cameras_[static_cast<std::size_t>(coarsest)], keyframe.mean_inverse_depth);
  if (direct.ok()) places.add(direct.T_keyframe_camera.inverse());
  TrackingResult best;
  int followed = 0;
  for (std::size_t i = 0; i < std::min(ranked.size(), kExamined) && followed < kFollowed; ++i) {
    if (ranked[i].found_share < ranked.front().found_share - kHopeless) break;
    if (start.search_budget && !start.search_budget->allows(SearchBudget::Step::kFollow)) break;
    if (places.know(ranked[i].at.T_camera_keyframe)) continue;
    const Alignment coarse =
        refine(keyframe, image, ranked[i].at, coarsest, coarsest, per_pixel(photometry_));
    if (places.know(coarse.T_camera_keyframe)) continue;
    places.add(coarse.T_camera_keyframe);
    ++followed;
    const TrackingResult result =
        verdict(keyframe, descend(keyframe, image, coarse, coarsest - 1, start.finest_level), start,
                coarsest);
    if (result.ok() >= best.ok() && result.found_share > best.found_share) best = result;
  }
  best.attempts = static_cast<int>(ranked.size());
  return best;
}

int Tracker::levels(const TrackingTarget& keyframe, const ImagePyramid& image) const {
  return std::min(
      {config_.pyramid_levels, image.levels(), static_cast<int>(keyframe.patches.size())});
}

TrackingResult Tracker::direct(const TrackingTarget& keyframe, const ImagePyramid& image,
                               const TrackingStart& wanted) {
  const int coarsest = levels(keyframe, image) - 1;
  const TrackingStart start = within(wanted, coarsest);
  const Entry from = entry(keyframe, image, start, coarsest);
  Alignment at = from.found
                     ? refine(keyframe, image, from.at, from.level, start.finest_level, photometry_)
                     : descend(keyframe, image, from.at, from.level, start.finest_level);
  if (config_.scan_speed) at = past_other_minima(keyframe, image, at, start);
  TrackingResult result = verdict(keyframe, at, start, from.level);
  result.attempts = 1;
  return result;
}

// Much less found than in the frame before: perhaps the wrong minimum.
bool Tracker::settled(const TrackingResult& direct, const TrackingStart& start) const {
  if (!direct.ok()) return false;
  if (!std::isfinite(start.error_px)) return direct.found_share >= kBeyondDoubt;
  return direct.found_share >= std::max(kDoubtful * start.found_share, kWellFound);
}

TrackingResult Tracker::search(const TrackingTarget& keyframe, const ImagePyramid& image,
                               const TrackingStart& wanted, const TrackingResult& direct) {
  const int coarsest = levels(keyframe, image) - 1;
  const TrackingResult searched =
      from_everywhere(keyframe, image, within(wanted, coarsest), coarsest, direct);
  const bool better = searched.ok() >= direct.ok() && searched.found_share > direct.found_share;
  TrackingResult result = better ? searched : direct;
  result.attempts = direct.attempts + searched.attempts;
  return result;
}

TrackingResult Tracker::track(const TrackingTarget& keyframe, const ImagePyramid& image,
                              const TrackingStart& start) {
  TrackingResult result = direct(keyframe, image, start);
  if (!config_.try_other_starts || settled(result, start)) return result;
  return search(keyframe, image, start, result);
}

TrackingResult Tracker::look(const TrackingTarget& keyframe, const ImagePyramid& image,
                             const Eigen::Isometry3d& T_keyframe_camera,
                             const TrackingStart& wanted) {
  const TrackingStart start = within(wanted, levels(keyframe, image) - 1);
  const auto level = static_cast<std::size_t>(start.finest_level);
  const Alignment at =
      assess(keyframe.patches[level], image.level(start.finest_level), cameras_[level],
             start_at(T_keyframe_camera, start.brightness), photometry_, workspace_);
  return verdict(keyframe, at, start, start.finest_level);
}

}  // namespace sparsight
