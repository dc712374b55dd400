#include "slam/loop/loop_verification.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "slam/geometry/se3.h"
#include "slam/loop/integrated_depth.h"
#include "slam/loop/pose_from_matches.h"
#include "slam/points/visibility.h"

namespace sparsight {
namespace {

// What the photometric information does not know: rounding of depths, integrated from poses with
// errors of their own.
constexpr double kFloorRad = 0.1 * M_PI / 180.0;
constexpr double kFloorM = 0.01;
constexpr double kStartErrorPx = 4.0;  // of a pose from matches
constexpr double kFaint = 1e-3;        // information that keeps a matrix invertible

TrackerConfig single_start(TrackerConfig config, int min_points) {
  config.try_other_starts = false;
  config.min_points = min_points;
  return config;
}

struct Fused {
  Eigen::Isometry3d T;
  Matrix6d information;
};

// Both directions as left perturbations of T_current_candidate; their images are the same, so that
// their information is not added but averaged, and what they disagree about counts as noise.
Fused fuse(const Eigen::Isometry3d& T, const Matrix6d& information,
           const Eigen::Isometry3d& T_other, const Matrix6d& information_other) {
  const Vector6d difference = log_se3(T_other * T.inverse());
  const Matrix6d sum = information + information_other;
  const Vector6d step =
      (sum + kFaint * Matrix6d::Identity()).ldlt().solve(information_other * difference);
  Vector6d floor;
  floor << Eigen::Vector3d::Constant(std::max(kFloorRad, difference.head<3>().norm())),
      Eigen::Vector3d::Constant(std::max(kFloorM, difference.tail<3>().norm()));
  Matrix6d covariance = (0.5 * sum + kFaint * Matrix6d::Identity()).inverse();
  covariance.diagonal() += floor.cwiseAbs2();
  const Matrix6d fused = covariance.inverse();
  return {exp_se3(step) * T, 0.5 * (fused + fused.transpose())};
}

}  // namespace

const char* name_of(LoopCheck::Verdict verdict) {
  switch (verdict) {
    case LoopCheck::Verdict::kAccepted:
      return "accepted";
    case LoopCheck::Verdict::kFewMatches:
      return "few_matches";
    case LoopCheck::Verdict::kNotAligned:
      return "not_aligned";
    case LoopCheck::Verdict::kDisagreement:
      return "disagreement";
    case LoopCheck::Verdict::kLittleOverlap:
      return "little_overlap";
    case LoopCheck::Verdict::kLittleFound:
      return "little_found";
  }
  return "unknown";
}

LoopVerifier::LoopVerifier(const CameraModel& camera, const LoopVerificationConfig& config,
                           const PointSelectionConfig& points, const TrackerConfig& tracker,
                           const PhotometryConfig& photometry)
    : camera_(camera),
      config_(config),
      points_(points),
      tracker_config_(single_start(tracker, config.min_points)),
      photometry_(photometry),
      tracker_(camera, tracker_config_, photometry) {
  points_.reject_depth_edges = false;  // told by neighbours along a ring, which are no more
}

// The candidate's points in the current image.
LoopVerifier::Start LoopVerifier::start_from_matches(const LoopView& current,
                                                     const LoopView& candidate) const {
  const std::vector<FeatureMatch> matches = match_features(current.features, candidate.features);
  const DepthLookup depth(candidate.returns, camera_);
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> normalized;
  for (const FeatureMatch& match : matches) {
    const auto point = depth.at(candidate.features.pixels[match.b]);
    if (!point) continue;
    points.push_back(*point);
    normalized.emplace_back(
        camera_.unproject(current.features.pixels[match.a].cast<double>()).head<2>());
  }
  const auto pose =
      pose_from_matches(points, normalized, config_.max_reprojection_px / camera_.intrinsics().fx,
                        config_.min_pose_inliers);
  if (!pose) return {};
  return {pose->T_camera_points, pose->inliers};
}

Keyframe LoopVerifier::keyframe_of(const LoopView& view) const {
  Keyframe keyframe;
  keyframe.pyramid = ImagePyramid(view.image, tracker_config_.pyramid_levels);
  keyframe.points = select_points(view.returns, hidden_from_camera(view.returns, camera_),
                                  view.image, camera_, points_);
  double sum = 0.0;
  for (const SelectedPoint& point : keyframe.points) sum += 1.0 / point.p_camera.z();
  keyframe.mean_inverse_depth =
      keyframe.points.empty() ? 0.0 : sum / static_cast<double>(keyframe.points.size());
  for (int level = 0; level < keyframe.pyramid.levels(); ++level) {
    keyframe.patches.push_back(make_patches(keyframe.pyramid, level, camera_, keyframe.points,
                                            photometry_.gradient_weight_constant));
  }
  return keyframe;
}

TrackingResult LoopVerifier::align(const Keyframe& host, const Keyframe& target,
                                   const Eigen::Isometry3d& start_T_host_target) {
  const TrackingStart start{.T_keyframe_previous = start_T_host_target,
                            .T_keyframe_predicted = start_T_host_target,
                            .error_px = kStartErrorPx};
  return tracker_.track(host, target.pyramid, start);
}

LoopCheck LoopVerifier::check(const LoopView& current, const LoopView& candidate) {
  using Verdict = LoopCheck::Verdict;
  LoopCheck check;
  const Start start = start_from_matches(current, candidate);
  check.pose_inliers = start.inliers;
  if (start.inliers == 0) return check;

  const Keyframe of_current = keyframe_of(current);
  const Keyframe of_candidate = keyframe_of(candidate);
  check.verdict = Verdict::kNotAligned;
  if (static_cast<int>(std::min(of_current.points.size(), of_candidate.points.size())) <
      config_.min_points) {
    return check;
  }
  // Each T_keyframe_camera; the information is of a left perturbation of its inverse.
  const TrackingResult forth = align(of_candidate, of_current, start.T_current_candidate.inverse());
  const TrackingResult back = align(of_current, of_candidate, start.T_current_candidate);
  check.overlap = std::min(forth.visible_ratio, back.visible_ratio);
  check.found_share = std::min(forth.found_share, back.found_share);
  if (!forth.ok() || !back.ok()) return check;

  const Eigen::Isometry3d T_forth = forth.T_keyframe_camera.inverse();
  const Eigen::Isometry3d& T_back = back.T_keyframe_camera;
  const Eigen::Isometry3d disagreement = T_forth * T_back.inverse();
  const Eigen::Isometry3d from_start = T_forth * start.T_current_candidate.inverse();
  check.disagreement_m = (T_forth.translation() - T_back.translation()).norm();
  check.disagreement_deg = rotation_deg(disagreement);
  const double from_start_m =
      (T_forth.translation() - start.T_current_candidate.translation()).norm();

  const Matrix6d turn = adjoint(T_back.inverse());
  const Fused fused =
      fuse(T_forth, forth.information, T_back, turn.transpose() * back.information * turn);
  check.T_current_candidate = fused.T;
  check.information = fused.information;
  if (check.disagreement_m > config_.max_disagreement_m ||
      check.disagreement_deg > config_.max_disagreement_deg ||
      from_start_m > config_.max_from_start_m ||
      rotation_deg(from_start) > config_.max_from_start_deg) {
    check.verdict = Verdict::kDisagreement;
  } else if (check.overlap < config_.min_overlap) {
    check.verdict = Verdict::kLittleOverlap;
  } else if (check.found_share < config_.min_found_share) {
    check.verdict = Verdict::kLittleFound;
  } else {
    check.verdict = Verdict::kAccepted;
  }
  return check;
}

}  // namespace sparsight
