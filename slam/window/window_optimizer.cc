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
  keyframes_.push_back(std::move(keyframe));
  pairs_.reset();
  Quadratic grown(size());
  grown.H.topLeftCorner(prior_.H.rows(), prior_.H.cols()) = prior_.H;
  grown.b.head(prior_.b.size()) = prior_.b;
  prior_ = std::move(grown);
}

Alignment WindowOptimizer::alignment_of(int host, int target) const {
  Alignment at;
  at.T_camera_keyframe = keyframe(target).T_world_camera.inverse() * keyframe(host).T_world_camera;
  const auto known = known_.find({keyframe(host).sequence, keyframe(target).sequence});
  if (known != known_.end()) {
    at.brightness = known->second.brightness;
    at.sigma_grey = known->second.sigma_grey;
  }
  return at;
}

PairTerm WindowOptimizer::linearize_pair(int host, int target) {
  return pair_term(keyframe(host), keyframe(target), camera_, alignment_of(host, target),
                   photometry_, workspace_);
}

std::vector<WindowOptimizer::Pair> WindowOptimizer::covisible_pairs() {
  std::vector<Pair> pairs;
  for (int host = 0; host < size(); ++host) {
    const int enough = std::max(
        config_.min_points, static_cast<int>(config_.min_visible_ratio *
                                             static_cast<double>(keyframe(host).points.size())));
    for (int target = 0; target < size(); ++target) {
      if (host == target) continue;
      Pair pair{host, target, linearize_pair(host, target)};
      const PatchAgreement agreement = patch_agreement(keyframe(host).patches.front(),
                                                       workspace_.current, pair.term.at.brightness);
      if (agreement.visible_patches < enough) continue;
      if (agreement.found_share < config_.min_found_share) continue;
      pairs.push_back(std::move(pair));
    }
  }
  return pairs;
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
    sum.b.segment<6>(h) += A.transpose() * pair.term.b;
    sum.b.segment<6>(t) -= pair.term.b;
  }
  return sum;
}

double WindowOptimizer::prior_energy() const {
  const Eigen::VectorXd d = increments_since_first();
  return d.dot(0.5 * (prior_.H * d) + prior_.b);
}

double WindowOptimizer::total_energy(const std::vector<Pair>& pairs) const {
  double energy = prior_energy();
  for (const Pair& pair : pairs) energy += pair.term.energy;
  return energy;
}

void WindowOptimizer::move(const Eigen::VectorXd& step) {
  for (int i = 0; i < size(); ++i) {
    Keyframe& moved = *keyframes_[static_cast<std::size_t>(i)];
    moved.T_world_camera = renormalized(moved.T_world_camera * exp_se3(step.segment<6>(6 * i)));
  }
}

// Takes the step, and the terms linearised there, if it lowers the energy for the scales it was
// computed with. Images are read once per step: what decides on the step also serves the next one.
bool WindowOptimizer::descend(std::vector<Pair>& pairs, const Eigen::VectorXd& step) {
  std::vector<Eigen::Isometry3d> poses;
  for (const auto& keyframe : keyframes_) poses.push_back(keyframe->T_world_camera);
  const std::map<PairKey, Photometry> known = known_;
  const double before = total_energy(pairs);

  move(step);
  double after = prior_energy();
  std::vector<Pair> moved;
  moved.reserve(pairs.size());
  for (const Pair& pair : pairs) {
    Photometry& next = known_[{keyframe(pair.host).sequence, keyframe(pair.target).sequence}];
    next = {pair.term.at.brightness, pair.term.at.sigma_grey};
    if (photometry_.affine_brightness) {
      const Vector6d xi = d_relative_d_host(pair) * step.segment<6>(6 * pair.host) -
                          step.segment<6>(6 * pair.target);
      const Eigen::Vector2d d = pair.term.brightness_step + pair.term.d_brightness_d_pose * xi;
      next.brightness.gain += d.x();
      next.brightness.offset += d.y();
    }
    moved.push_back({pair.host, pair.target, linearize_pair(pair.host, pair.target)});
    after += energy_at(pair.term, workspace_.current, photometry_);
    if (!(after < before)) break;  // no pair's energy is negative
  }
  if (after < before) {
    pairs = std::move(moved);
    return true;
  }
  for (std::size_t i = 0; i < keyframes_.size(); ++i) keyframes_[i]->T_world_camera = poses[i];
  known_ = known;
  return false;
}

WindowSummary WindowOptimizer::optimize(std::optional<int> most_iterations) {
  const int limit =
      std::min(config_.max_iterations, most_iterations.value_or(config_.max_iterations));
  WindowSummary summary;
  pairs_ = covisible_pairs();
  std::vector<Pair>& pairs = *pairs_;
  summary.pairs = static_cast<int>(pairs.size());
  summary.initial_energy = summary.final_energy = total_energy(pairs);
  if (size() < 2 || pairs.empty()) return summary;

  double damping = 0.0;
  while (summary.iterations < limit && !summary.converged) {
    ++summary.iterations;
    const Eigen::VectorXd step = solve_holding_oldest(energy_about_current(pairs), damping);
    if (!step.allFinite()) break;
    double largest_px = 0.0;
    for (int i = 1; i < size(); ++i) {
      largest_px = std::max(
          largest_px, camera_.intrinsics().fx *
                          (step.segment<3>(6 * i).norm() +
                           step.segment<3>(6 * i + 3).norm() * keyframe(i).mean_inverse_depth));
    }
    if (descend(pairs, step)) {
      damping = damping > kFirstDamping ? 0.1 * damping : 0.0;
    } else {
      damping = std::max(kFirstDamping, 10.0 * damping);
    }
    summary.converged = largest_px < config_.convergence_px || damping > kMostDamping;
  }
  summary.final_energy = total_energy(pairs);
  return summary;
}

// One pair: the others share its points, and with them its errors.
bool WindowOptimizer::teach(SelfCalibration& calibration) {
  if (!pairs_) return false;
  for (const Pair& pair : *pairs_) {
    if (pair.target != size() - 1 || pair.host != size() - 2) continue;
    const PairTerm term = linearize_pair(pair.host, pair.target);
    calibration.observe(keyframe(pair.host), term.at, workspace_.current, photometry_);
  }
  return calibration.update();
}

void WindowOptimizer::set_camera(const CameraModel& camera) {
  camera_ = camera;
  for (const auto& keyframe : keyframes_) {
    for (int level = 0; level < keyframe->pyramid.levels(); ++level) {
      keyframe->patches[static_cast<std::size_t>(level)] = make_patches(
          keyframe->pyramid, level, camera, keyframe->points, photometry_.gradient_weight_constant);
    }
  }
  pairs_.reset();
}

void WindowOptimizer::forget_pairs_of_oldest() {
  const std::uint64_t leaver = oldest().sequence;
  std::erase_if(known_, [&](const auto& entry) {
    return entry.first.first == leaver || entry.first.second == leaver;
  });
  if (!pairs_) return;
  std::erase_if(*pairs_, [](const Pair& pair) { return pair.host == 0 || pair.target == 0; });
  for (Pair& pair : *pairs_) {
    --pair.host;
    --pair.target;
  }
}

MarginalizedKeyframe WindowOptimizer::marginalize_oldest() {
  MarginalizedKeyframe result;
  if (size() > 1) {
    if (!pairs_) pairs_ = covisible_pairs();
    const Quadratic everything = energy_about_current(*pairs_);
    // From the successor's body increment to the left increment of T_keyframe_successor.
    const Matrix6d A = adjoint(keyframe(1).T_world_camera.inverse() * keyframe(0).T_world_camera);
    result.successor_information = A.transpose() * information_of_second(everything) * A;

    // Only the terms that involve the leaver go into the prior; the others are evaluated anew.
    std::vector<Pair> leaving;
    for (const Pair& pair : *pairs_) {
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
