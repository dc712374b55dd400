#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>

#include "slam/geometry/se3.h"
#include "slam/tracking/photometric_kernel.h"
#include "slam/tracking/photometry_config.h"

namespace sparsight {

struct AlignmentConfig {
  int max_iterations = 30;       // per pyramid level
  double convergence_px = 0.01;  // a step that moves the points by less ends the level
};

// Where a frame stands relative to its keyframe, in space and brightness, and how well it fits.
struct Alignment {
  Eigen::Isometry3d T_camera_keyframe = Eigen::Isometry3d::Identity();  // T_m^n of eq. (1)
  Brightness brightness;
  double sigma_grey = 5.0;  // sigma_r of eq. (5); the start of its next estimation
  double cost = 0.0;        // robust_cost() at sigma_grey
  double visible_share = 0.0;
  bool converged = false;
  Matrix6d information = Matrix6d::Zero();  // of the left increment, brightness marginalised out
};

// Scratch space of the alignment; keeps its capacity from call to call.
struct AlignmentWorkspace {
  Linearization current;
  Linearization candidate;

  // Afterwards patch sets of up to so many entries are aligned without allocating.
  void reserve(std::size_t entries) {
    current.resize(entries);
    candidate.resize(entries);
  }
};

enum class Information { kTold, kLeftOut };

// Minimises eq. (4) at one pyramid level by Gauss–Newton, damped only after a step that failed.
// mean_inverse_depth (1/m) of the patches turns a step into pixels. Who only compares poses does
// without the information of the one found, which is zero then. Thread-bound, deterministic.
Alignment align(const PatchSet& patches, const GreyImage& image, const CameraModel& camera,
                double mean_inverse_depth, const Alignment& start, const AlignmentConfig& config,
                const PhotometryConfig& photometry, AlignmentWorkspace& workspace,
                Information information = Information::kTold);

// Cost and sigma of a pose as it is, without a step; the linearisation is left in
// workspace.current.
Alignment assess(const PatchSet& patches, const GreyImage& image, const CameraModel& camera,
                 const Alignment& at, const PhotometryConfig& photometry,
                 AlignmentWorkspace& workspace);

// J^T w J and J^T w r there, with the prior on brightness if that is estimated.
NormalEquations normal_equations(const PatchSet& patches, const Linearization& linearization,
                                 const Alignment& at, const PhotometryConfig& photometry);

}  // namespace sparsight
