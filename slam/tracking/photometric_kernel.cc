#include "slam/tracking/photometric_kernel.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

// The kernels keep vectors in arrays, which SVE's, whose size the machine decides, cannot be in;
// arm64 runs NEON.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "slam/tracking/photometric_kernel.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "slam/tracking/photometric_kernel-inl.h"

#if HWY_ONCE
namespace sparsight {

HWY_EXPORT(linearize_entries);
HWY_EXPORT(weighted_square_sums);
HWY_EXPORT(log_likelihood_sums);
HWY_EXPORT(patch_log_sums);
HWY_EXPORT(robust_weights);
HWY_EXPORT(normal_equation_sums);
HWY_EXPORT(column_sums);

namespace {

template <typename Number, std::size_t kLanes>
double total(const std::array<Number, kLanes>& lanes) {
  using Lanes = Eigen::Array<Number, static_cast<int>(kLanes), 1>;
  return Eigen::Map<const Lanes>(lanes.data()).template cast<double>().sum();
}

// One column per patch.
using PatchColumns =
    Eigen::Map<const Eigen::Array<float, static_cast<int>(kPatternSize), Eigen::Dynamic>>;

PatchColumns columns_of(const std::vector<float>& entries) {
  return {entries.data(), static_cast<int>(kPatternSize),
          static_cast<Eigen::Index>(entries.size() / kPatternSize)};
}

ProjectionParameters projection_parameters(const GreyImage& image, const CameraModel& camera,
                                           const Eigen::Isometry3d& T,
                                           const Brightness& brightness) {
  const CameraIntrinsics& c = camera.intrinsics();
  ProjectionParameters p;
  const Eigen::Matrix<float, 3, 4> T_float = T.matrix().topRows<3>().cast<float>();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) p.T[4 * row + column] = T_float(row, column);
  }
  p.fx = static_cast<float>(c.fx);
  p.fy = static_cast<float>(c.fy);
  p.cx = static_cast<float>(c.cx);
  p.cy = static_cast<float>(c.cy);
  p.distortion = {static_cast<float>(c.k1), static_cast<float>(c.k2), static_cast<float>(c.p1),
                  static_cast<float>(c.p2), static_cast<float>(c.k3)};
  p.distorted = c.distorted();
  p.max_radius2 = static_cast<float>(camera.max_radius2());
  p.gain = static_cast<float>(brightness.gain);
  p.offset = static_cast<float>(brightness.offset);
  p.pixels = image.pixels.data();
  p.width = image.width;
  p.height = image.height;
  return p;
}

NormalEquations normal_equations_of(const NormalSums& sums) {
  NormalEquations result;
  std::size_t next = 0;
  for (int row = 0; row < NormalEquations::kSize; ++row) {
    for (int column = row; column < NormalEquations::kSize; ++column) {
      result.H(row, column) = result.H(column, row) = total(sums[next++]);
    }
  }
  for (int row = 0; row < NormalEquations::kSize; ++row) result.b(row) = total(sums[next++]);
  return result;
}

}  // namespace

void Linearization::resize(std::size_t entries) {
  if (residual.size() == entries) return;
  residual.resize(entries);
  weight.resize(entries);
  for (std::vector<float>& column : J) column.resize(entries);
  const std::size_t patches = entries / kPatternSize;
  const std::size_t padded = (patches + kPatchLanes - 1) / kPatchLanes * kPatchLanes;
  patch_squares.resize(padded);
  patch_pixels.resize(padded);
  std::fill(patch_squares.begin() + static_cast<std::ptrdiff_t>(patches), patch_squares.end(), 0.0);
  std::fill(patch_pixels.begin() + static_cast<std::ptrdiff_t>(patches), patch_pixels.end(), 0.0);
  robust_weight.resize(entries);
}

void sum_patches(Linearization& l) {
  const PatchColumns weight = columns_of(l.weight);
  const PatchColumns residual = columns_of(l.residual);
  Eigen::Map<Eigen::ArrayXd>(l.patch_squares.data(), weight.cols()) =
      (weight * residual.square()).colwise().sum().transpose().cast<double>();
  Eigen::Map<Eigen::ArrayXd>(l.patch_pixels.data(), weight.cols()) =
      weight.colwise().sum().transpose().cast<double>();
}

void linearize(const PatchSet& patches, const GreyImage& image, const CameraModel& camera,
               const Eigen::Isometry3d& T_camera_keyframe, const Brightness& brightness,
               Linearization& out) {
  out.resize(patches.entries());
  HWY_DYNAMIC_DISPATCH(linearize_entries)
  (patches, projection_parameters(image, camera, T_camera_keyframe, brightness), out);
}

double estimate_sigma(const Linearization& linearization, double student_t_dof,
                      double sigma_start) {
  constexpr int kMaxIterations = 20;
  constexpr double kRelativeTolerance = 1e-3;
  double sigma = std::max(sigma_start, kMinSigma);
  for (int i = 0; i < kMaxIterations; ++i) {
    LaneSums squares;
    LaneSums weights;
    HWY_DYNAMIC_DISPATCH(weighted_square_sums)
    (linearization, static_cast<float>(student_t_dof), static_cast<float>(1.0 / (sigma * sigma)),
     squares, weights);
    const double weight = total(weights);
    if (weight <= 0.0) return sigma;
    const double updated = std::max(std::sqrt(total(squares) / weight), kMinSigma);
    const bool settled = std::abs(updated - sigma) < kRelativeTolerance * sigma;
    sigma = updated;
    if (settled) break;
  }
  return sigma;
}

double robust_cost(const Linearization& linearization, double student_t_dof, double sigma) {
  LaneSums costs;
  LaneSums weights;
  HWY_DYNAMIC_DISPATCH(log_likelihood_sums)
  (linearization, static_cast<float>(1.0 / (student_t_dof * sigma * sigma)), costs, weights);
  const double weight = total(weights);
  if (weight <= 0.0) return std::numeric_limits<double>::infinity();
  return (student_t_dof + 1.0) * sigma * sigma * total(costs) / weight;
}

double patch_log_sum(const Linearization& linearization, double student_t_dof, double scale) {
  PatchLaneSums sums;
  HWY_DYNAMIC_DISPATCH(patch_log_sums)(linearization, student_t_dof, scale, sums);
  return total(sums);
}

double weight_sum(const std::vector<float>& weights) {
  LaneSums sums;
  HWY_DYNAMIC_DISPATCH(column_sums)(weights, sums);
  return total(sums);
}

double visible_share(const PatchSet& patches, const Linearization& linearization) {
  const double all = weight_sum(patches.weight);
  return all > 0.0 ? weight_sum(linearization.weight) / all : 0.0;
}

NormalEquations accumulate(const PatchSet& patches, const Linearization& linearization,
                           double student_t_dof, double sigma) {
  HWY_DYNAMIC_DISPATCH(robust_weights)
  (linearization, static_cast<float>(student_t_dof), static_cast<float>(1.0 / (sigma * sigma)),
   linearization.robust_weight);
  return accumulate_weighted(patches, linearization, linearization.robust_weight);
}

NormalEquations accumulate_weighted(const PatchSet& patches, const Linearization& linearization,
                                    const std::vector<float>& weights) {
  NormalSums sums;
  HWY_DYNAMIC_DISPATCH(normal_equation_sums)(patches, linearization, weights, sums);
  return normal_equations_of(sums);
}

}  // namespace sparsight
#endif
