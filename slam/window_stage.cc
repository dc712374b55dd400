#include "slam/window_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "slam/lidar/rough_points.h"
#include "slam/points/camera_returns.h"
#include "slam/points/visibility.h"
#include "slam/tracking/patch_texture.h"
#include "slam/tracking/strangers.h"

namespace sparsight {
namespace {

// While less is found of what a frame should show, strangers may fill it.
constexpr double kCalmShare = 0.8;

bool calm(const FrameOutcome& outcome) {
  if (outcome.status != FrameOutcome::Status::kTracked) return true;
  return outcome.tracking.found_share >= kCalmShare && !outcome.tracking.vouched;
}

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

// What the camera does not see would take the colour of what hides it.
std::vector<CloudPoint> colored(const std::vector<CameraReturn>& returns,
                                const std::vector<bool>& hidden, const SynchronizedFrame& frame) {
  std::vector<CloudPoint> cloud;
  cloud.reserve(returns.size());
  for (std::size_t i = 0; i < returns.size(); ++i) {
    if (hidden[i]) {
      cloud.push_back(
          {.p_camera = returns[i].p_camera, .intensity = returns[i].intensity, .colored = false});
    } else {
      cloud.push_back(colored(returns[i], frame));
    }
  }
  return cloud;
}

double mean_inverse_depth(const std::vector<SelectedPoint>& points) {
  double sum = 0.0;
  for (const SelectedPoint& point : points) sum += 1.0 / point.p_camera.z();
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

}  // namespace

WindowStage::WindowStage(const RigCalibration& calibration, const OdometryConfig& config)
    : calibration_(calibration),
      config_(config),
      camera_(calibration.camera),
      window_(camera_, config.window, config.photometry),
      self_calibration_(calibration.camera, config.self_calibration) {}

bool WindowStage::accept(const SynchronizedFrame& frame, const TrackedFrame& tracked) {
  considered_ = frame.sequence;
  std::unique_ptr<Keyframe> keyframe = make_keyframe(frame, tracked);
  if (static_cast<int>(keyframe->points.size()) < config_.tracker.min_points) return false;
  // One that was tracked has shown that it has texture; one in the dark must not be the only one.
  const bool alone = keyframe->begins_submap || window_.size() == 0;
  if (alone && textured_patches(keyframe->patches.front()) < config_.tracker.min_points) {
    return false;
  }
  if (keyframe->begins_submap) {
    finish();
    ++submap_;
  }
  window_.add(std::move(keyframe));
  if (std::exchange(other_camera_, false)) {
    camera_ = self_calibration_.camera();
    window_.set_camera(camera_);
  }
  return true;
}

void WindowStage::optimize(std::optional<int> most_iterations) {
  window_.optimize(most_iterations);
  if (window_.full()) retire_oldest();
  // Used from the next keyframe on: this one's patches, at all levels, need not be made again.
  if (config_.self_calibration.enabled && window_.teach(self_calibration_)) other_camera_ = true;
}

// Where it was tracked, from its keyframe as that is known now: while the frame waited, the window
// may have been optimised.
Eigen::Isometry3d WindowStage::pose_of(const TrackedFrame& tracked) {
  const FrameOutcome& outcome = tracked.outcome;
  if (window_.size() == 0 || window_.latest().sequence != outcome.keyframe_sequence) {
    return outcome.T_world_camera;
  }
  return window_.latest().T_world_camera * outcome.tracking.T_keyframe_camera;
}

std::unique_ptr<Keyframe> WindowStage::make_keyframe(const SynchronizedFrame& frame,
                                                     const TrackedFrame& tracked) {
  const CameraModel& camera = self_calibration_.camera();
  const MotionModel& motion = tracked.motion;
  const Eigen::Isometry3d T_exposure_keyframe = motion.at(frame.exposure).inverse();
  const auto motion_around = [&](double seconds) -> Eigen::Isometry3d {
    return T_exposure_keyframe *
           motion.at(frame.exposure + std::chrono::nanoseconds(std::llround(1e9 * seconds)));
  };
  const std::vector<CameraReturn> returns =
      returns_in_image(frame.sweep, camera, calibration_.T_camera_lidar, motion_around);
  const std::vector<bool> hidden = hidden_from_camera(returns, camera);

  auto keyframe = std::make_unique<Keyframe>();
  keyframe->sequence = frame.sequence;
  keyframe->exposure = frame.exposure;
  keyframe->T_world_camera = pose_of(tracked);
  keyframe->begins_submap = tracked.outcome.status == FrameOutcome::Status::kLost;
  keyframe->pyramid = tracked.pyramid;
  const bool weighs_rough = config_.photometry.weigh_down_rough;
  if (weighs_rough || config_.tracker.sweep_arbiter) {
    keyframe->surface = surface_of(frame.sweep, calibration_.T_camera_lidar, motion_around);
  }
  keyframe->points = select_points(returns, hidden, frame.grey, camera, config_.points);
  keyframe->mean_inverse_depth = mean_inverse_depth(keyframe->points);
  if (weighs_rough && calm(tracked.outcome)) {
    weigh_down_rough(keyframe->points, keyframe->surface, calibration_.T_camera_lidar);
  }
  PatchSet finest = patches_of(*keyframe, 0);
  if (config_.photometry.weigh_down_strangers && window_.size() > 0 &&
      tracked.outcome.status == FrameOutcome::Status::kTracked &&
      window_.latest().sequence == tracked.outcome.keyframe_sequence) {
    weigh_down_strangers(keyframe->points, finest, window_.latest().pyramid.level(0), camera,
                         tracked.outcome.tracking.T_keyframe_camera,
                         tracked.outcome.tracking.vouched);
  }
  keyframe->patches.push_back(std::move(finest));
  for (int level = 1; level < tracked.pyramid.levels(); ++level) {
    keyframe->patches.push_back(patches_of(*keyframe, level));
  }
  keyframe->cloud_camera = colored(returns, hidden, frame);
  return keyframe;
}

PatchSet WindowStage::patches_of(const Keyframe& keyframe, int level) const {
  return make_patches(keyframe.pyramid, level, self_calibration_.camera(), keyframe.points,
                      config_.photometry.gradient_weight_constant);
}

void WindowStage::retire_oldest() {
  MarginalizedKeyframe marginalized = window_.marginalize_oldest();
  Keyframe& keyframe = *marginalized.keyframe;
  RetiredKeyframe result{.sequence = keyframe.sequence,
                         .exposure = keyframe.exposure,
                         .T_world_camera = keyframe.T_world_camera,
                         .cloud_camera = std::move(keyframe.cloud_camera),
                         .pyramid = std::move(keyframe.pyramid),
                         .begins_submap = keyframe.begins_submap};
  if (window_.size() > 0) {
    const Keyframe& successor = window_.oldest();
    result.successor = {
        .sequence = successor.sequence,
        .T_keyframe_successor = keyframe.T_world_camera.inverse() * successor.T_world_camera,
        .information = marginalized.successor_information};
  }
  retired_.push_back(std::move(result));
}

void WindowStage::describe(TrackingReference& out) {
  out.version = ++version_;
  out.considered = considered_;
  out.camera = camera_;
  out.keyframes = window_.size();
  out.submap = submap_;
  if (window_.size() == 0) return;
  out.keyframe = window_.latest();
  count_rough_fully(window_.latest().points, out.keyframe.patches);
}

std::vector<RetiredKeyframe> WindowStage::take_retired() { return std::exchange(retired_, {}); }

void WindowStage::finish() {
  while (window_.size() > 0) retire_oldest();
}

}  // namespace sparsight
