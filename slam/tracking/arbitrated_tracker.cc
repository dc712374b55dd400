#include "slam/tracking/arbitrated_tracker.h"

#include <algorithm>

namespace sparsight {
namespace {

// Less of the sweep on the keyframe's surface, and the LiDAR is asked where it would be.
constexpr double kAsKnown = 0.8;
// For so many frames after one that the image left in doubt, it leaves each of them so: between two
// cars much may be found of one.
constexpr int kFramesOfTraffic = 10;
constexpr double kNearlyAll = 0.9;  // of the patches: no traffic and no wrong pose leaves so much
constexpr double kBetter = 0.1;     // that much more on the surface is not chance
constexpr double kMost = 0.5;       // less is no opinion
// Of what lay on the surface, and of what was found, a frame before: traffic comes and goes, but a
// rig that is carried off sees something else at once.
constexpr double kSuddenly = 0.8;
constexpr double kGradually = 0.3;
constexpr double kAgreeM = 0.15;
constexpr double kAgreeDeg = 1.0;
constexpr double kHardly = 0.75;
constexpr double kSeenAtAll = 0.1;  // of the patches; in the dark none is found

// Where the LiDAR is sure it errs by centimetres.
bool agree(const SweepArbiter::Opinion& opinion, const TrackingResult& result) {
  const Eigen::Isometry3d apart = opinion.T_keyframe_camera.inverse() * result.T_keyframe_camera;
  return apart.translation().norm() < kAgreeM && rotation_deg(apart) < kAgreeDeg;
}

}  // namespace

ArbitratedTracker::ArbitratedTracker(const RigCalibration& calibration, const TrackerConfig& config,
                                     const PhotometryConfig& photometry)
    : asks_(config.sweep_arbiter),
      searches_(config.try_other_starts),
      tracker_(CameraModel(calibration.camera), config, photometry),
      arbiter_(calibration.T_camera_lidar) {}

TrackingResult ArbitratedTracker::track(const TrackingTarget& keyframe, const ImagePyramid& image,
                                        const Sweep& sweep, const Vector6d& twist,
                                        const TrackingStart& start) {
  if (!asks_ || keyframe.surface.empty() || sweep.returns.empty()) {
    return tracker_.track(keyframe, image, start);
  }
  arbiter_.hear(sweep, twist, keyframe.surface, start.T_keyframe_predicted);
  Attempt best = attempt(keyframe, image, start, start);
  const bool beyond_doubt =
      best.settled && best.result.found_share >= kNearlyAll && best.share >= kMost;
  if (!beyond_doubt && (in_doubt(best) || best.share < kAsKnown)) {
    best = arbitrate(keyframe, image, start, best);
  }
  const bool believed = best.settled || best.result.vouched;
  if (believed) share_before_ = best.share;
  if (best.result.vouched && best.result.found_share < kWellFound) {
    in_traffic_ = kFramesOfTraffic;
  } else if (in_traffic_ > 0) {
    --in_traffic_;
  }
  if (believed || !searches_) return best.result;
  return tracker_.search(keyframe, image, start, best.result);
}

ArbitratedTracker::Attempt ArbitratedTracker::attempt(const TrackingTarget& keyframe,
                                                      const ImagePyramid& image,
                                                      const TrackingStart& start,
                                                      const TrackingStart& expected) {
  Attempt made{.result = tracker_.direct(keyframe, image, start)};
  made.share = arbiter_.share(made.result.T_keyframe_camera);
  made.settled = tracker_.settled(made.result, expected);
  return made;
}

bool ArbitratedTracker::contradicts(const SweepArbiter::Opinion& opinion,
                                    const Attempt& attempt) const {
  return opinion.share > attempt.share + kBetter ||
         (in_doubt(attempt) && !agree(opinion, attempt.result));
}

// From the LiDAR's pose; where it decides and the image leads away again, at it.
ArbitratedTracker::Attempt ArbitratedTracker::attempt_at(const SweepArbiter::Opinion& opinion,
                                                         bool decides,
                                                         const TrackingTarget& keyframe,
                                                         const ImagePyramid& image,
                                                         const TrackingStart& start) {
  TrackingStart there = start;
  there.T_keyframe_predicted = there.T_keyframe_previous = opinion.T_keyframe_camera;
  Attempt made = attempt(keyframe, image, there, start);
  if (decides && contradicts(opinion, made)) {
    made.result = tracker_.look(keyframe, image, opinion.T_keyframe_camera, start);
    made.share = opinion.share;
    made.settled = tracker_.settled(made.result, start);
  }
  return made;
}

ArbitratedTracker::Attempt ArbitratedTracker::arbitrate(const TrackingTarget& keyframe,
                                                        const ImagePyramid& image,
                                                        const TrackingStart& start,
                                                        const Attempt& first) {
  const bool expected_better = arbiter_.share(start.T_keyframe_predicted) > first.share;
  const SweepArbiter::Opinion opinion = arbiter_.opinion(
      expected_better ? start.T_keyframe_predicted : first.result.T_keyframe_camera);
  const bool reachable = tracker_.reachable(opinion.T_keyframe_camera, start);
  const bool as_before = opinion.share > std::max(kMost, kSuddenly * share_before_);
  const bool decides = opinion.sure && as_before && reachable;

  Attempt best = first;
  if (reachable && (decides ? contradicts(opinion, first) : !first.settled)) {
    const Attempt there = attempt_at(opinion, decides, keyframe, image, start);
    const double found = first.result.found_share;
    const bool finds_more = there.result.ok() >= first.result.ok() &&
                            there.result.found_share > found &&
                            tracker_.reachable(there.result.T_keyframe_camera, start);
    // Of two poses that lie on the surface nearly alike, one that the image hardly finds is wrong.
    const bool alike = first.settled && opinion.share <= first.share + kBetter;
    const bool hardly = there.result.found_share < kHardly * found;
    if (finds_more || (decides && !(alike && hardly))) best = there;
    best.result.attempts = 2;
  }
  const bool vouched =
      decides && agree(opinion, best.result) &&
      best.result.status != TrackingResult::Status::kTooFewPoints &&
      best.result.found_share >= std::max(kSeenAtAll, kGradually * start.found_share);
  if (!vouched) return best;
  if (!best.result.ok()) best.result.status = TrackingResult::Status::kConverged;
  best.result.vouched = true;
  return best;
}

}  // namespace sparsight
