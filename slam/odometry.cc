#include "slam/odometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "slam/points/camera_returns.h"
#include "slam/tracking/motion_model.h"
#include "slam/tracking/strangers.h"

namespace sparsight {
namespace {

constexpr double kErrorMemory = 0.7;  // how fast the expected error of the prediction calms down
constexpr int kPatientFrames = 3;     // untracked frames before a new keyframe is forced

CloudPoint colored(const CameraReturn& r, const SynchronizedFrame& frame) {
  CloudPoint point{.p_camera = r.p_camera, .intensity = r.intensity};
  const auto u = static_cast<int>(std::lround(r.pixel.x()));
  const auto v = static_cast<int>(std::lround(r.pixel.y()));
  if (frame.color && !frame.color->empty()) {
    const std::size_t at = 3 * (static_cast<std::size_t>(v) * frame.color->width + u);
    std::copy_n(frame.color->rgb.begin() + static_cast<std::ptrdiff_t>(at), 3, point.rgb.begin());
  } else {
    point.rgb.fill(frame.grey.at(u, v));
  }
  return point;
}

double mean_inverse_depth(const std::vector<SelectedPoint>& points) {
  double sum = 0.0;
  for (const SelectedPoint& point : points) sum += 1.0 / point.p_camera.z();
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

}  // namespace

struct Odometry::State {
  State(const RigCalibration& rig, const OdometryConfig& settings)
      : calibration(rig),
        config(settings),
        camera(rig.camera),
        tracker(camera, settings.tracker, settings.photometry),
        window(camera, settings.window, settings.photometry),
        self_calibration(rig.camera, settings.self_calibration) {}

  RigCalibration calibration;
  OdometryConfig config;
  CameraModel camera;
  Tracker tracker;
  WindowOptimizer window;
  SelfCalibration self_calibration;

  MotionModel motion;
  Brightness brightness;  // of the last tracked frame relative to the keyframe
  double start_error_px = std::numeric_limits<double>::infinity();
  double found_share = 0.0;  // of the last tracked frame
  int untracked = 0;         // frames in a row
  int in_doubt = 0;          // frames in a row: their velocity is no ground to refuse another
  // Of the frame last tracked, for add_keyframe.
  ImagePyramid pyramid;
  FrameOutcome outcome;
  std::vector<RetiredKeyframe> retired;

  FrameOutcome follow(const SynchronizedFrame& frame);
  void learn(const SynchronizedFrame& frame, const TrackingResult& result,
             const TrackingStart& start);
  std::unique_ptr<Keyframe> make_keyframe(const SynchronizedFrame& frame) const;
  void recalibrate();
  void retire_oldest();
};

// The usual case: a keyframe stands, the frame has an image.
FrameOutcome Odometry::State::follow(const SynchronizedFrame& frame) {
  const Keyframe& keyframe = window.latest();
  FrameOutcome result;
  result.keyframe_sequence = keyframe.sequence;
  const TrackingStart start{
      .T_keyframe_previous = motion.last_in_keyframe(),
      .T_keyframe_predicted = motion.predict_in_keyframe(frame.exposure),
      .brightness = brightness,
      .error_px = start_error_px,
      .found_share = found_share,
      .seconds_since_previous =
          in_doubt < kPatientFrames ? motion.seconds_since_last(frame.exposure) : std::nullopt};
  if (!pyramid.empty()) result.tracking = tracker.track(keyframe, pyramid, start);
  if (result.tracking.ok()) {
    result.status = FrameOutcome::Status::kTracked;
    untracked = 0;
    learn(frame, result.tracking, start);
  } else {
    result.status = FrameOutcome::Status::kPredicted;
    result.tracking.T_keyframe_camera = start.T_keyframe_predicted;
    ++untracked;
  }
  in_doubt = result.tracking.well_found() ? 0 : in_doubt + 1;
  result.T_world_camera = keyframe.T_world_camera * result.tracking.T_keyframe_camera;

  const bool old = to_seconds(frame.exposure - keyframe.exposure) >= config.keyframes.max_age_s;
  const bool little_in_common = result.tracking.visible_ratio < config.keyframes.min_visible_ratio;
  const bool second_of_all = window.size() < 2;
  result.becomes_keyframe = !frame.sweep.returns.empty() && !pyramid.empty() &&
                            (result.tracking.ok() ? old || little_in_common || second_of_all
                                                  : untracked >= kPatientFrames);
  return result;
}

void Odometry::State::learn(const SynchronizedFrame& frame, const TrackingResult& result,
                            const TrackingStart& start) {
  const Keyframe& keyframe = window.latest();
  const bool predicted = motion.twist().has_value();
  const Vector6d error = log_se3(start.T_keyframe_predicted.inverse() * result.T_keyframe_camera);
  const double error_px =
      camera.intrinsics().fx *
      (error.head<3>().norm() + error.tail<3>().norm() * keyframe.mean_inverse_depth);
  motion.observe(frame.exposure, result.T_keyframe_camera, !result.well_found());
  brightness = result.brightness;
  found_share = result.found_share;
  if (predicted) {
    start_error_px = std::isfinite(start_error_px)
                         ? std::max(error_px, kErrorMemory * start_error_px)
                         : error_px;
  }
}

std::unique_ptr<Keyframe> Odometry::State::make_keyframe(const SynchronizedFrame& frame) const {
  const Eigen::Isometry3d T_exposure_keyframe = motion.at(frame.exposure).inverse();
  const auto motion_around = [&](double seconds) -> Eigen::Isometry3d {
    return T_exposure_keyframe *
           motion.at(frame.exposure + std::chrono::nanoseconds(std::llround(1e9 * seconds)));
  };
  const std::vector<CameraReturn> returns =
      returns_in_image(frame.sweep, camera, calibration.T_camera_lidar, motion_around);

  auto keyframe = std::make_unique<Keyframe>();
  keyframe->sequence = frame.sequence;
  keyframe->exposure = frame.exposure;
  keyframe->T_world_camera = outcome.T_world_camera;
  keyframe->predicted = outcome.status == FrameOutcome::Status::kPredicted;
  keyframe->pyramid = pyramid;
  keyframe->points = select_points(returns, frame.grey, camera, config.points);
  keyframe->mean_inverse_depth = mean_inverse_depth(keyframe->points);
  for (int level = 0; level < pyramid.levels(); ++level) {
    keyframe->patches.push_back(make_patches(pyramid, level, camera, keyframe->points,
                                             config.photometry.gradient_weight_constant));
  }
  if (config.photometry.weigh_down_strangers && window.size() > 0 && outcome.tracking.ok()) {
    weigh_down_strangers(keyframe->patches, window.keyframe(window.size() - 1).pyramid.level(0),
                         camera, outcome.tracking.T_keyframe_camera);
  }
  keyframe->cloud_camera.reserve(returns.size());
  for (const CameraReturn& r : returns) keyframe->cloud_camera.push_back(colored(r, frame));
  return keyframe;
}

void Odometry::State::recalibrate() {
  camera = self_calibration.camera();
  tracker.set_camera(camera);
  window.set_camera(camera);
}

void Odometry::State::retire_oldest() {
  MarginalizedKeyframe marginalized = window.marginalize_oldest();
  Keyframe& keyframe = *marginalized.keyframe;
  RetiredKeyframe result{.sequence = keyframe.sequence,
                         .exposure = keyframe.exposure,
                         .T_world_camera = keyframe.T_world_camera,
                         .cloud_camera = std::move(keyframe.cloud_camera),
                         .pyramid = std::move(keyframe.pyramid),
                         .predicted = keyframe.predicted};
  if (window.size() > 0) {
    const Keyframe& successor = window.oldest();
    result.successor = {
        .sequence = successor.sequence,
        .T_keyframe_successor = keyframe.T_world_camera.inverse() * successor.T_world_camera,
        .information = marginalized.successor_information};
  }
  retired.push_back(std::move(result));
}

Odometry::Odometry(const RigCalibration& calibration, const OdometryConfig& config)
    : state_(std::make_unique<State>(calibration, config)) {}

Odometry::~Odometry() = default;

FrameOutcome Odometry::track(const SynchronizedFrame& frame) {
  State& s = *state_;
  s.pyramid = frame.grey.empty() ? ImagePyramid()
                                 : ImagePyramid(frame.grey, s.config.tracker.pyramid_levels);
  if (s.window.size() > 0) {
    s.outcome = s.follow(frame);
  } else {
    s.outcome = {};
    s.outcome.becomes_keyframe = !s.pyramid.empty() && !frame.sweep.returns.empty();
    if (s.outcome.becomes_keyframe) s.outcome.status = FrameOutcome::Status::kFirst;
    s.outcome.keyframe_sequence = frame.sequence;
  }
  return s.outcome;
}

void Odometry::add_keyframe(const SynchronizedFrame& frame) {
  State& s = *state_;
  std::unique_ptr<Keyframe> keyframe = s.make_keyframe(frame);
  if (static_cast<int>(keyframe->points.size()) < s.config.tracker.min_points) return;
  s.window.add(std::move(keyframe));
  s.window.optimize();
  // What leaves goes by the terms that were minimised, before the camera changes them.
  if (s.window.full()) s.retire_oldest();
  if (s.config.self_calibration.enabled && s.window.teach(s.self_calibration)) s.recalibrate();
  s.motion.rebase(frame.exposure);
  s.untracked = 0;
  s.brightness = {};
}

const CameraIntrinsics& Odometry::camera() const { return state_->camera.intrinsics(); }

std::vector<RetiredKeyframe> Odometry::take_retired() { return std::exchange(state_->retired, {}); }

void Odometry::finish() {
  while (state_->window.size() > 0) state_->retire_oldest();
}

}  // namespace sparsight
