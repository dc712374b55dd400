#include "slam/lidar/sweep_arbiter.h"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "slam/lidar/sweep_alignment.h"
#include "slam/lidar/sweep_sample.h"

namespace sparsight {
namespace {

// By the information, which takes every return for itself; the error is some five times as large.
constexpr double kSureM = 0.01;
constexpr double kSureRad = 0.1 * M_PI / 180.0;
// The returns of a sweep are moved to the exposure by a velocity that is a frame old, and hands
// that turn a rig as fast as this change it within one.
constexpr double kFastTurnRadS = 0.5;
// Returns that speak for each direction; a few planes at edges face where no wall does.
constexpr double kFewestFacing = 15.0;

double weakest(const Eigen::Matrix3d& block) {
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(block, Eigen::EigenvaluesOnly)
      .eigenvalues()(0);
}

bool is_sure(const SweepFit& fit) {
  if (weakest(fit.facing) < kFewestFacing) return false;
  // Of rotation and of translation, each with the other eliminated.
  const Eigen::Matrix3d A = fit.information.topLeftCorner<3, 3>();
  const Eigen::Matrix3d B = fit.information.topRightCorner<3, 3>();
  const Eigen::Matrix3d C = fit.information.bottomRightCorner<3, 3>();
  if (!(weakest(A) > 0.0) || !(weakest(C) > 0.0)) return false;
  const Eigen::Matrix3d rotation = A - B * C.ldlt().solve(B.transpose());
  const Eigen::Matrix3d translation = C - B.transpose() * A.ldlt().solve(B);
  return weakest(rotation) * kSureRad * kSureRad > 1.0 &&
         weakest(translation) * kSureM * kSureM > 1.0;
}

}  // namespace

SweepArbiter::SweepArbiter(const Eigen::Isometry3d& T_camera_lidar)
    : T_camera_lidar_(T_camera_lidar), T_lidar_camera_(T_camera_lidar.inverse()) {
  sample_.reserve(kMostSampled);
}

void SweepArbiter::hear(const Sweep& sweep, const Vector6d& twist, const SweepSurface& surface,
                        const Eigen::Isometry3d& T_keyframe_camera) {
  surface_ = &surface;
  blurred_ = !sweep.motion_compensated && twist.head<3>().norm() > kFastTurnRadS;
  sample_sweep(sweep, adjoint(T_lidar_camera_) * twist, surface, in_lidar(T_keyframe_camera),
               sample_);
}

double SweepArbiter::share(const Eigen::Isometry3d& T_keyframe_camera) const {
  return fit_of_sweep(*surface_, sample_, in_lidar(T_keyframe_camera)).share;
}

SweepArbiter::Opinion SweepArbiter::opinion(const Eigen::Isometry3d& start) const {
  const SweepFit fit = align_sweep(*surface_, sample_, in_lidar(start));
  return {.T_keyframe_camera = T_camera_lidar_ * fit.T_keyframe_lidar * T_lidar_camera_,
          .share = fit.share,
          .sure = !blurred_ && is_sure(fit)};
}

}  // namespace sparsight
