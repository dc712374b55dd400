#include "slam/window/window_optimizer.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "slam/tracking/patch_agreement.h"

namespace sparsight {
namespace {

constexpr double kFirstDamping = 1e-3;
constexpr double kMostDamping = 1e3;
constexpr double kMidGrey = 128.0;
constexpr double kRelinearizationGrey = 0.5;
// At the image's corner. The pixels that are compared move nearly together.
constexpr double kRelinearizationCameraPx = 0.5;

const Eigen::Isometry3d& linearization_point(const Keyframe& keyframe) {
  return keyframe.T_world_camera_first ? *keyframe.T_world_camera_first : keyframe.T_world_camera;
}

Eigen::VectorXd solve_holding_oldest(const Quadratic& energy, double damping) {
  const Eigen::Index free = energy.b.size() - 6;
  Eigen::MatrixXd H = energy.H.bottomRightCorner(free, free);
  H.diagonal() *= 1.0 + damping;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(energy.b.size());
  step.tail(free) = H.ldlt().solve(-energy.b.tail(free));
  return step;
}

}  // namespace

WindowOptimizer::WindowOptimizer(const CameraModel& camera, const WindowConfig& config,
                                 const PhotometryConfig& photometry)
    : camera_(camera), config_(config), photometry_(photometry) {}

void WindowOptimizer::add(std::unique_ptr<Keyframe> keyframe) {
  // The one before is no longer tracked against: the window looks at the finest level only.
  if (size() > 0) latest().patches.resize(1);
  keyframes_.push_back(std::move(keyframe));
  Quadratic grown(size());
  grown.H.topLeftCorner(prior_.H.rows(), prior_.H.cols()) = prior_.H;
  grown.b.head(prior_.b.size()) = prior_.b;
  prior_ = std::move(grown);
}

Eigen::Isometry3d WindowOptimizer::T_target_host(int host, int target) const {
  return keyframe(target).T_world_camera.inverse() * keyframe(host).T_world_camera;
}

PairTerm WindowOptimizer::linearize(int host, int target, const Alignment& start) {
  Alignment at = start;
  at.T_camera_keyframe = T_target_host(host, target);
  return pair_term(keyframe(host), keyframe(target), camera_, at, photometry_, workspace_);
}

void WindowOptimizer::add_if_covisible(int host, int target) {
  const auto points = static_cast<double>(keyframe(host).points.size());
  const int enough =
      std::max(config_.min_points, static_cast<int>(config_.min_visible_ratio * points));
  Pair pair{host, target, linearize(host, target, {})};
  const PatchAgreement agreement =
      patch_agreement(keyframe(host).patches.front(), workspace_.current, pair.term.at.brightness);
  if (agreement.visible_patches < enough) return;
  if (agreement.found_share < config_.min_found_share) return;
  pairs_.push_back(std::move(pair));
}

void WindowOptimizer::update_pairs() {
  const bool other_camera = camera_moved_px_ > kRelinearizationCameraPx;
  if (other_camera) camera_moved_px_ = 0.0;
  for (Pair& pair : pairs_) {
    const Vector6d xi = moved_since_linearized(pair);
    if (!other_camera && !outdated(pair, xi)) continue;
    pair.term = linearize(pair.host, pair.target, pair.term.moved(xi));
  }
  for (; looked_at_ < size(); ++looked_at_) {
    for (int earlier = 0; earlier < looked_at_; ++earlier) {
      add_if_covisible(earlier, looked_at_);
      add_if_covisible(looked_at_, earlier);
    }
  }
}

Vector6d WindowOptimizer::moved_since_linearized(const Pair& pair) const {
  return log_se3(T_target_host(pair.host, pair.target) * pair.term.at.T_camera_keyframe.inverse());
}

double WindowOptimizer::pixels_moved(const Vector6d& xi, const Keyframe& keyframe) const {
  return camera_.intrinsics().fx *
         (xi.head<3>().norm() + xi.tail<3>().norm() * keyframe.mean_inverse_depth);
}

bool WindowOptimizer::outdated(const Pair& pair, const Vector6d& xi) const {
  if (pixels_moved(xi, keyframe(pair.host)) > config_.relinearization_px) return true;
  const Brightness then = pair.term.at.brightness;
  const Brightness now = pair.term.moved(xi).brightness;
  const double gain = now.gain - then.gain;
  const double mid_grey = kMidGrey * gain + now.offset - then.offset;
  return std::max(std::abs(mid_grey), kMidGrey * std::abs(gain)) > kRelinearizationGrey;
}

// xi = Ad(T_target_host) eta_host - eta_target. The adjoint is taken at the first estimates of
// poses that the prior touches, so that prior and new terms agree on what they cannot observe, the
// pose of the whole window (first-estimate Jacobians; Huang et al. 2009, and DSO, Sec. 2.3).
Matrix6d WindowOptimizer::d_relative_d_host(const Pair& pair) const {
  return adjoint(linearization_point(keyframe(pair.target)).inverse() *
                 linearization_point(keyframe(pair.host)));
}

Eigen::VectorXd WindowOptimizer::increments_since_first() const {
  Eigen::VectorXd d = Eigen::VectorXd::Zero(6 * size());
  for (int i = 0; i < size(); ++i) {
    d.segment<6>(6 * i) =
        log_se3(linearization_point(keyframe(i)).inverse() * keyframe(i).T_world_camera);
  }
  return d;
}

// Pairs and prior, b taken at the current poses.
Quadratic WindowOptimizer::energy_about_current(const std::vector<Pair>& pairs) const {
  Quadratic sum(size());
  sum.H = prior_.H;
  sum.b = prior_.b + prior_.H * increments_since_first();
  for (const Pair& pair : pairs) {
    const int h = 6 * pair.host;
    const int t = 6 * pair.target;
    const Matrix6d A = d_relative_d_host(pair);
    const Matrix6d weighted = pair.term.H * A;
    sum.H.block<6, 6>(h, h) += A.transpose() * weighted;
    sum.H.block<6, 6>(t, t) += pair.term.H;
    sum.H.block<6, 6>(t, h) -= weighted;
    sum.H.block<6, 6>(h, t) -= weighted.transpose();
    const Vector6d gradient = pair.term.gradient_at(moved_since_linearized(pair));
    sum.b.segment<6>(h) += A.transpose() * gradient;
    sum.b.segment<6>(t) -= gradient;
  }
  return sum;
}

double WindowOptimizer::prior_energy() const {
  const Eigen::VectorXd d = increments_since_first();
  return d.dot(0.5 * (prior_.H * d) + prior_.b);
}

double WindowOptimizer::total_energy() const {
  double energy = prior_energy();
  for (const Pair& pair : pairs_) energy += pair.term.energy_at(moved_since_linearized(pair));
  return energy;
}

void WindowOptimizer::move(const Eigen::VectorXd& step) {
  for (int i = 0; i < size(); ++i) {
    Keyframe& moved = *keyframes_[static_cast<std::size_t>(i)];
    moved.T_world_camera = renormalized(moved.T_world_camera * exp_se3(step.segment<6>(6 * i)));
  }
}

double WindowOptimizer::largest_move_px(const Eigen::VectorXd& step) const {
  double largest = 0.0;
  for (int i = 0; i < size(); ++i) {
    largest = std::max(largest, pixels_moved(step.segment<6>(6 * i), keyframe(i)));
  }
  return largest;
}

// Takes the step, and the terms linearised there, if it lowers the energy for the scales it was
// computed with. Images are read once per step: what decides on the step also serves the next one.
bool WindowOptimizer::descend(const Eigen::VectorXd& step) {
  std::vector<Eigen::Isometry3d> poses;
  for (const auto& keyframe : keyframes_) poses.push_back(keyframe->T_world_camera);
  const double before = total_energy();

  move(step);
  double after = prior_energy();
  std::vector<Pair> moved = pairs_;
  for (Pair& pair : moved) {
    const Vector6d xi = moved_since_linearized(pair);
    if (outdated(pair, xi)) {
      const PairTerm old = pair.term;
      pair.term = linearize(pair.host, pair.target, old.moved(xi));
      after += energy_at(old, workspace_.current, photometry_);
    } else {
      after += pair.term.energy_at(xi);
    }
    if (!(after < before)) break;  // no pair's energy is negative
  }
  if (after < before) {
    pairs_ = std::move(moved);
    return true;
  }
  for (std::size_t i = 0; i < keyframes_.size(); ++i) keyframes_[i]->T_world_camera = poses[i];
  return false;
}

WindowSummary WindowOptimizer::optimize(std::optional<int> most_iterations) {
  const int limit =
      std::min(config_.max_iterations, most_iterations.value_or(config_.max_iterations));
  WindowSummary summary;
  update_pairs();
  summary.pairs = static_cast<int>(pairs_.size());
  summary.initial_energy = summary.final_energy = total_energy();
  if (size() < 2 || pairs_.empty()) return summary;

  double damping = 0.0;
  while (summary.iterations < limit && !summary.converged) {
    ++summary.iterations;
    const Eigen::VectorXd step = solve_holding_oldest(energy_about_current(pairs_), damping);
    if (!step.allFinite()) break;
    if (descend(step)) {
      damping = damping > kFirstDamping ? 0.1 * damping : 0.0;
    } else {
      damping = std::max(kFirstDamping, 10.0 * damping);
    }
    summary.converged = largest_move_px(step) < config_.convergence_px || damping > kMostDamping;
  }
  summary.final_energy = total_energy();
  return summary;
}

// One pair: the others share its points, and with them its errors.
bool WindowOptimizer::teach(SelfCalibration& calibration) {
  for (const Pair& pair : pairs_) {
    if (pair.target != size() - 1 || pair.host != size() - 2) continue;
    const PairTerm term = linearize(pair.host, pair.target, pair.term.at);
    calibration.observe(keyframe(pair.host), term.at, workspace_.current, photometry_);
  }
  return calibration.update();
}

void WindowOptimizer::set_camera(const CameraModel& camera) {
  Eigen::Vector2d corner;
  const bool sees = camera.project(camera_.unproject(Eigen::Vector2d::Zero()), corner);
  camera_moved_px_ += sees ? corner.norm() : kRelinearizationCameraPx;
  camera_ = camera;
  for (std::size_t i = 0; i + 1 < keyframes_.size(); ++i) {
    Keyframe& earlier = *keyframes_[i];
    earlier.patches.front() = make_patches(earlier.pyramid, 0, camera, earlier.points,
                                           photometry_.gradient_weight_constant);
  }
}

void WindowOptimizer::forget_pairs_of_oldest() {
  std::erase_if(pairs_, [](const Pair& pair) { return pair.host == 0 || pair.target == 0; });
  for (Pair& pair : pairs_) {
    --pair.host;
    --pair.target;
  }
  --looked_at_;
}

MarginalizedKeyframe WindowOptimizer::marginalize_oldest() {
  MarginalizedKeyframe result;
  if (size() > 1) {
    if (looked_at_ < size()) update_pairs();
    const Quadratic everything = energy_about_current(pairs_);
    // From the successor's body increment to the left increment of T_keyframe_successor.
    const Matrix6d A = adjoint(keyframe(1).T_world_camera.inverse() * keyframe(0).T_world_camera);
    result.successor_information = A.transpose() * information_of_second(everything) * A;

    // Only the terms that involve the leaver go into the prior; the others are evaluated anew.
    std::vector<Pair> leaving;
    for (const Pair& pair : pairs_) {
      if (pair.host == 0 || pair.target == 0) leaving.push_back(pair);
    }
    Quadratic energy = energy_about_current(leaving);
    energy.b -= energy.H * increments_since_first();  // about the first estimates again
    prior_ = without_first(energy);
    for (std::size_t i = 1; i < keyframes_.size(); ++i) {
      Keyframe& touched = *keyframes_[i];
      if (!touched.T_world_camera_first) touched.T_world_camera_first = touched.T_world_camera;
    }
  } else {
    prior_ = Quadratic(0);
  }
  forget_pairs_of_oldest();
  result.keyframe = std::move(keyframes_.front());
  keyframes_.erase(keyframes_.begin());
  return result;
}

}  // namespace sparsight
