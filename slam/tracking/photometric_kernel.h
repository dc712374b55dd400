#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "hal/image.h"
#include "slam/geometry/camera_model.h"
#include "slam/tracking/patch_set.h"

namespace sparsight {

// Brightness of a frame relative to its keyframe: I_n = gain * I_m + offset (DSO's affine model,
// Engel et al. 2018, Sec. 2.1).
struct Brightness {
  double gain = 1.0;
  double offset = 0.0;  // grey levels
};

// Residuals r of eq. (3) and d_r / d_xi for the left increment xi of eq. (2), one per entry of a
// PatchSet. Entries that do not project into the image have weight 0.
struct Linearization {
  std::vector<float> residual;          // grey levels
  std::vector<float> weight;            // PatchSet::weight where inside the image, else 0
  std::array<std::vector<float>, 6> J;  // grey levels per rad, per metre
  // Of each patch, sum w r^2 and sum w, once sum_patches() was called; zeros up to a multiple of
  // kPatchLanes.
  std::vector<double> patch_squares;
  std::vector<double> patch_pixels;
  static constexpr std::size_t kPatchLanes = 8;

  // Where robust_model.h computes, kept so that it allocates once. No part of the value.
  mutable std::vector<float> robust_weight;

  // Keeps its memory when it shrinks.
  void resize(std::size_t entries);
};

// Weighted least squares in [xi, gain, offset]; H and b as sums over the entries, not divided by
// sigma^2.
struct NormalEquations {
  static constexpr int kSize = 8;
  Eigen::Matrix<double, kSize, kSize> H = Eigen::Matrix<double, kSize, kSize>::Zero();
  Eigen::Matrix<double, kSize, 1> b = Eigen::Matrix<double, kSize, 1>::Zero();
};

// The inner loops of tracking and of the window, vectorised for the machine at hand (Highway
// chooses at run time). Every sum runs over the same sixteen lanes in the same order, whatever the
// width of the machine's vectors. Real-time-safe once the Linearization has its size.

// Eq. (3): r = I_n(pi(T p)) - (gain * I_m + offset), T = T_n_m, image and camera of one level.
void linearize(const PatchSet& patches, const GreyImage& image, const CameraModel& camera,
               const Eigen::Isometry3d& T_camera_keyframe, const Brightness& brightness,
               Linearization& out);

// Of what is weighed by patches; whoever weighs each pixel by itself does not need it.
void sum_patches(Linearization& linearization);

// sigma of eq. (5): the fixed point of sigma^2 = sum w(r) r^2 / n, started at sigma_start (Kerl et
// al. 2013, Sec. III-B). At least kMinSigma.
inline constexpr double kMinSigma = 0.3;  // grey levels: quantisation to 8 bits
double estimate_sigma(const Linearization& linearization, double student_t_dof, double sigma_start);

// Mean negative log-likelihood of the t-distribution, up to a constant, times sigma^2: the energy
// that eq. (4) descends for a given sigma. Infinite if no entry has weight.
double robust_cost(const Linearization& linearization, double student_t_dof, double sigma);

// Sum over the patches of (dof + sum w) log(1 + scale sum w r^2).
double patch_log_sum(const Linearization& linearization, double student_t_dof, double scale);

// Sum of the weights of a PatchSet or a Linearization.
double weight_sum(const std::vector<float>& weights);

// Share of the patch set's weight that projects into the image.
double visible_share(const PatchSet& patches, const Linearization& linearization);

// Sums J^T w J and J^T w r with w of eq. (5).
NormalEquations accumulate(const PatchSet& patches, const Linearization& linearization,
                           double student_t_dof, double sigma);

// The same with the given weights, one per entry.
NormalEquations accumulate_weighted(const PatchSet& patches, const Linearization& linearization,
                                    const std::vector<float>& weights);

}  // namespace sparsight
