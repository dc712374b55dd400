#include "slam/tracking_stage.h"

#include <algorithm>
#include <cmath>

namespace sparsight {
namespace {

constexpr double kErrorMemory = 0.7;  // how fast the expected error of the prediction calms down
// Frames in question, and the time since the last that was not, before tracking is lost.
constexpr int kPatientFrames = 3;
constexpr double kPatienceS = 0.25;
// Of the share that was found in the last trusted frame: less puts tracking in question, so much
// takes it out again. One end of a corridor finds 60 % of the other.
constexpr double kSuddenly = 0.7;
constexpr double kAsBefore = 0.8;
constexpr double kChangesS = 0.15;        // how long a keyframe is good in passing traffic
constexpr double kVelocityMemoryS = 1.0;  // after so long without tracking it may be any other

// Of an image relative to a later keyframe, both known relative to an earlier one.
Brightness relative_to(const Brightness& keyframe, const Brightness& image) {
  const double gain = image.gain / keyframe.gain;
  return {.gain = gain, .offset = image.offset - gain * keyframe.offset};
}

}  // namespace

TrackingStage::TrackingStage(const RigCalibration& calibration, const OdometryConfig& config)
    : calibration_(calibration),
      config_(config),
      tracker_(calibration, config.tracker, config.photometry) {}

void TrackingStage::prepare(TrackedFrame& out) {
  GreyImage image{.width = calibration_.camera.width, .height = calibration_.camera.height};
  image.pixels.resize(static_cast<std::size_t>(image.width) *
                      static_cast<std::size_t>(image.height));
  out.pyramid.assign(image, config_.tracker.pyramid_levels);
  tracker_.rehearse_search(out.pyramid);
}

void TrackingStage::track(const SynchronizedFrame& frame, const TrackingReference& reference,
                          TrackedFrame& out, int finest_level, SearchBudget* search_budget) {
  if (frame.grey.empty()) {
    out.pyramid.clear();
  } else {
    out.pyramid.assign(frame.grey, config_.tracker.pyramid_levels);
  }
  take_up(reference);
  if (reference.keyframes > 0) {
    out.outcome = follow(frame, reference, out.pyramid, finest_level, search_budget);
  } else {
    out.outcome = {};
    out.outcome.becomes_keyframe =
        !handed_over_ && !out.pyramid.empty() && !frame.sweep.returns.empty();
    if (out.outcome.becomes_keyframe) out.outcome.status = FrameOutcome::Status::kFirst;
    out.outcome.keyframe_sequence = handed_over_.value_or(frame.sequence);
  }
  if (out.outcome.becomes_keyframe) {
    handed_over_ = frame.sequence;
    brightness_at_hand_over_ = brightness_;
  }
  out.motion = motion_;
}

void TrackingStage::take_up(const TrackingReference& reference) {
  if (reference.version == reference_version_) return;
  reference_version_ = reference.version;
  if (reference.considered && handed_over_ == reference.considered) handed_over_.reset();
  if (reference.keyframes == 0) return;
  tracker_.set_camera(reference.camera);
  if (keyframe_ == reference.keyframe.sequence) return;
  keyframe_ = reference.keyframe.sequence;
  if (submap_ != reference.submap) begin_submap(reference);
  motion_.rebase(reference.keyframe.exposure);
  brightness_ = relative_to(brightness_at_hand_over_, brightness_);
  last_trusted_ = std::max(last_trusted_, reference.keyframe.exposure);
}

void TrackingStage::begin_submap(const TrackingReference& reference) {
  submap_ = reference.submap;
  in_question_ = lost_ = false;
  questioned_ = 0;
  trusted_share_ = 0.0;
  if (to_seconds(reference.keyframe.exposure - last_trusted_) < kVelocityMemoryS) return;
  motion_.restart(reference.keyframe.exposure);
  velocity_confirmed_ = false;
  brightness_ = brightness_at_hand_over_;
  start_error_px_ = std::numeric_limits<double>::infinity();
  found_share_ = 0.0;
}

// The usual case: a keyframe stands, the frame has an image.
FrameOutcome TrackingStage::follow(const SynchronizedFrame& frame,
                                   const TrackingReference& reference, const ImagePyramid& pyramid,
                                   int finest_level, SearchBudget* search_budget) {
  const TrackingTarget& keyframe = reference.keyframe;
  FrameOutcome result;
  result.keyframe_sequence = keyframe.sequence;
  result.submap = reference.submap;
  const TrackingStart start{
      .T_keyframe_previous = motion_.last_in_keyframe(),
      .T_keyframe_predicted = predicted(frame.exposure),
      .brightness = brightness_,
      .error_px = start_error_px_,
      .found_share = found_share_,
      .seconds_since_previous =
          velocity_confirmed_ ? motion_.seconds_since_last(frame.exposure) : std::nullopt,
      .finest_level = finest_level,
      .search_budget = search_budget};
  if (!pyramid.empty()) {
    const Vector6d twist = motion_.twist().value_or(Vector6d::Zero());
    result.tracking = tracker_.track(keyframe, pyramid, frame.sweep, twist, start);
  }
  judge(frame, result.tracking);
  result.in_question = in_question_;
  if (result.tracking.ok() && !lost_) {
    result.status = FrameOutcome::Status::kTracked;
    learn(frame, reference, result.tracking, start);
  } else {
    result.status = lost_ ? FrameOutcome::Status::kLost : FrameOutcome::Status::kPredicted;
    result.tracking.T_keyframe_camera = start.T_keyframe_predicted;
  }
  result.T_world_camera = keyframe.T_world_camera * result.tracking.T_keyframe_camera;
  result.becomes_keyframe = !frame.sweep.returns.empty() && !pyramid.empty() && !handed_over_ &&
                            wants_keyframe(frame, reference, result);
  return result;
}

void TrackingStage::judge(const SynchronizedFrame& frame, const TrackingResult& result) {
  const double as_before = result.found_share / std::max(trusted_share_, kWellFound);
  if (!result.vouched && (!result.ok() || as_before < kSuddenly)) in_question_ = true;
  if (result.well_found() && as_before >= kAsBefore) in_question_ = false;
  if (!in_question_) {
    lost_ = false;
    questioned_ = 0;
    last_trusted_ = frame.exposure;
    trusted_share_ = result.found_share;
    return;
  }
  ++questioned_;
  lost_ = lost_ || (questioned_ >= kPatientFrames &&
                    to_seconds(frame.exposure - last_trusted_) >= kPatienceS);
}

// As far as the velocity tells.
Eigen::Isometry3d TrackingStage::predicted(HostTime exposure) const {
  const auto memory = std::chrono::nanoseconds(std::llround(1e9 * kVelocityMemoryS));
  return motion_.predict_in_keyframe(std::min(exposure, last_trusted_ + memory));
}

bool TrackingStage::wants_keyframe(const SynchronizedFrame& frame,
                                   const TrackingReference& reference,
                                   const FrameOutcome& outcome) const {
  using Status = FrameOutcome::Status;
  if (outcome.in_question) return outcome.status == Status::kLost;
  const double age_s = to_seconds(frame.exposure - reference.keyframe.exposure);
  const bool old = age_s >= config_.keyframes.max_age_s;
  const bool little_in_common =
      outcome.tracking.visible_ratio < config_.keyframes.min_visible_ratio;
  const bool second_of_all = reference.keyframes < 2;
  // What the keyframe shows has gone, or something stands before it.
  const bool changed =
      outcome.tracking.vouched && outcome.tracking.found_share < kWellFound && age_s >= kChangesS;
  return old || little_in_common || second_of_all || changed;
}

void TrackingStage::learn(const SynchronizedFrame& frame, const TrackingReference& reference,
                          const TrackingResult& result, const TrackingStart& start) {
  const bool predicted = motion_.twist().has_value();
  if (predicted && !velocity_confirmed_) {
    TrackingStart confirmed = start;
    confirmed.seconds_since_previous = motion_.seconds_since_last(frame.exposure);
    velocity_confirmed_ = tracker_.reachable(result.T_keyframe_camera, confirmed);
  }
  const Vector6d error = log_se3(start.T_keyframe_predicted.inverse() * result.T_keyframe_camera);
  const double error_px =
      reference.camera.intrinsics().fx *
      (error.head<3>().norm() + error.tail<3>().norm() * reference.keyframe.mean_inverse_depth);
  motion_.observe(frame.exposure, result.T_keyframe_camera, !result.well_found());
  brightness_ = result.brightness;
  found_share_ = result.found_share;
  if (predicted) {
    start_error_px_ = std::isfinite(start_error_px_)
                          ? std::max(error_px, kErrorMemory * start_error_px_)
                          : error_px;
  }
}

}  // namespace sparsight
