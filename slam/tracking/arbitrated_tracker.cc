#include "slam/tracking/arbitrated_tracker.h"

namespace sparsight {
namespace {

// Of what the LiDAR sees: less on the keyframe's surface, and it is asked where it would be
// instead.
constexpr double kAsKnown = 0.8;
constexpr double kBetter = 0.1;  // that much more on the surface is not chance
constexpr double kMost = 0.5;
constexpr double kSeenAtAll = 0.1;  // of the patches; in the dark none is found

TrackingStart from(const SweepArbiter::Opinion& opinion, TrackingStart start) {
  start.T_keyframe_predicted = start.T_keyframe_previous = opinion.T_keyframe_camera;
  return start;
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
  if (!best.settled || best.share < kAsKnown) best = arbitrate(keyframe, image, start, best);
  if (best.settled || best.result.vouched || !searches_) return best.result;
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

ArbitratedTracker::Attempt ArbitratedTracker::arbitrate(const TrackingTarget& keyframe,
                                                        const ImagePyramid& image,
                                                        const TrackingStart& start,
                                                        const Attempt& first) {
  const bool expected_better = arbiter_.share(start.T_keyframe_predicted) > first.share;
  const SweepArbiter::Opinion opinion = arbiter_.opinion(
      expected_better ? start.T_keyframe_predicted : first.result.T_keyframe_camera);
  const bool possible = start.in_doubt || tracker_.reachable(opinion.T_keyframe_camera, start);
  const bool decides = opinion.sure && opinion.share > kMost && possible;
  const bool contradicts = opinion.share > first.share + kBetter;

  Attempt best = first;
  if (possible && (decides ? contradicts : !first.settled)) {
    Attempt there = attempt(keyframe, image, from(opinion, start), start);
    there.result.attempts += first.result.attempts;
    if (decides && there.share < opinion.share - kBetter) {
      there.result = tracker_.look(keyframe, image, opinion.T_keyframe_camera, start);
    }
    const bool finds_more = there.result.ok() >= first.result.ok() &&
                            there.result.found_share > first.result.found_share;
    if (decides || finds_more) best = there;
  }
  if (!decides || best.result.status == TrackingResult::Status::kTooFewPoints ||
      best.result.found_share < kSeenAtAll) {
    return best;
  }
  if (!best.result.ok()) best.result.status = TrackingResult::Status::kConverged;
  best.result.vouched = true;
  return best;
}

}  // namespace sparsight
