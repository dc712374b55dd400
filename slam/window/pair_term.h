#pragma once

#include "slam/geometry/camera_model.h"
#include "slam/geometry/se3.h"
#include "slam/keyframe.h"
#include "slam/tracking/photometric_alignment.h"

namespace sparsight {

// One summand of eq. (6): the points of one keyframe (host) seen in another (target), to second
// order in the relative pose. The brightness between the two images is a nuisance of this pair
// alone and is eliminated from it.
struct PairTerm {
  Alignment at;                   // T_target_host, brightness, sigma
  Matrix6d H = Matrix6d::Zero();  // of the left increment of T_target_host, over sigma^2
  Vector6d b = Vector6d::Zero();
  double energy = 0.0;  // robust cost of all visible pixels, over sigma^2
  double pixels = 0.0;  // their weight
  // Brightness follows the pose: d_brightness = brightness_step + d_brightness_d_pose * xi.
  Eigen::Vector2d brightness_step = Eigen::Vector2d::Zero();
  Eigen::Matrix<double, 2, 6> d_brightness_d_pose = Eigen::Matrix<double, 2, 6>::Zero();

  // The term after the left increment xi of T_target_host, to second order.
  Vector6d gradient_at(const Vector6d& xi) const { return b + H * xi; }
  double energy_at(const Vector6d& xi) const { return energy + xi.dot(b + 0.5 * (H * xi)); }
  // Where a look from there starts.
  Alignment moved(const Vector6d& xi) const;
};

// Linearises at start.T_camera_keyframe, with sigma estimated there; the linearisation is left in
// workspace.current.
PairTerm pair_term(const Keyframe& host, const Keyframe& target, const CameraModel& camera,
                   const Alignment& start, const PhotometryConfig& photometry,
                   AlignmentWorkspace& workspace);

// What term.energy becomes where the pair is linearised now, for the same sigma and the same number
// of pixels.
double energy_at(const PairTerm& term, const Linearization& linearization,
                 const PhotometryConfig& photometry);

}  // namespace sparsight
