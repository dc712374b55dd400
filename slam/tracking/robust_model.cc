#include "slam/tracking/robust_model.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sparsight {
namespace {

// One column per patch.
using PatchColumns =
    Eigen::Map<const Eigen::Array<float, static_cast<int>(kPatternSize), Eigen::Dynamic>>;

PatchColumns columns_of(const std::vector<float>& entries) {
  return {entries.data(), static_cast<int>(kPatternSize),
          static_cast<Eigen::Index>(entries.size() / kPatternSize)};
}

Eigen::Map<Eigen::ArrayXd> array_of(std::vector<double>& scratch, std::size_t entries) {
  scratch.resize(entries / kPatternSize);
  return {scratch.data(), static_cast<Eigen::Index>(scratch.size())};
}

// One element per patch, in the linearisation's scratch space.
struct PatchSums {
  Eigen::Map<Eigen::ArrayXd> squares;  // sum of w r^2
  Eigen::Map<Eigen::ArrayXd> pixels;   // sum of w

  explicit PatchSums(const Linearization& l)
      : squares(array_of(l.scratch.patch_squares, l.weight.size())),
        pixels(array_of(l.scratch.patch_pixels, l.weight.size())) {
    const PatchColumns weight = columns_of(l.weight);
    const PatchColumns residual = columns_of(l.residual);
    squares = (weight * residual.square()).colwise().sum().transpose().cast<double>();
    pixels = weight.colwise().sum().transpose().cast<double>();
  }
  // An expression: nothing is computed, or stored, before it is used.
  auto weights(double dof, double sigma) const {
    return (dof + pixels) / (dof + squares / (sigma * sigma));
  }
};

}  // namespace

double estimate_sigma(const Linearization& linearization, const PhotometryConfig& photometry,
                      double sigma_start) {
  if (!photometry.patch_weights) {
    return estimate_sigma(linearization, photometry.student_t_dof, sigma_start);
  }
  constexpr int kMaxIterations = 30;
  constexpr double kRelativeTolerance = 1e-3;
  const PatchSums patches(linearization);
  const double pixels = patches.pixels.sum();
  double sigma = std::max(sigma_start, kMinSigma);
  if (pixels <= 0.0) return sigma;
  for (int i = 0; i < kMaxIterations; ++i) {
    const double squares =
        (patches.weights(photometry.student_t_dof, sigma) * patches.squares).sum();
    const double updated = std::max(std::sqrt(squares / pixels), kMinSigma);
    const bool settled = std::abs(updated - sigma) < kRelativeTolerance * sigma;
    sigma = updated;
    if (settled) break;
  }
  return sigma;
}

double robust_cost(const Linearization& linearization, const PhotometryConfig& photometry,
                   double sigma) {
  if (!photometry.patch_weights) {
    return robust_cost(linearization, photometry.student_t_dof, sigma);
  }
  const double dof = photometry.student_t_dof;
  const PatchSums patches(linearization);
  const double pixels = patches.pixels.sum();
  if (pixels <= 0.0) return std::numeric_limits<double>::infinity();
  const double cost =
      ((dof + patches.pixels) * (1.0 + patches.squares / (dof * sigma * sigma)).log()).sum();
  return 0.5 * sigma * sigma * cost / pixels;
}

NormalEquations accumulate(const PatchSet& patches, const Linearization& linearization,
                           const PhotometryConfig& photometry, double sigma) {
  if (!photometry.patch_weights) {
    return accumulate(patches, linearization, photometry.student_t_dof, sigma);
  }
  const PatchSums sums(linearization);
  const double dof = photometry.student_t_dof;
  const PatchColumns pixel_weights = columns_of(linearization.weight);
  std::vector<float>& weights = linearization.scratch.weights;
  weights.resize(linearization.weight.size());
  Eigen::Map<Eigen::Array<float, static_cast<int>(kPatternSize), Eigen::Dynamic>> columns(
      weights.data(), static_cast<int>(kPatternSize), pixel_weights.cols());
  for (Eigen::Index patch = 0; patch < columns.cols(); ++patch) {
    const double weight =
        (dof + sums.pixels(patch)) / (dof + sums.squares(patch) / (sigma * sigma));
    columns.col(patch) = pixel_weights.col(patch) * static_cast<float>(weight);
  }
  return accumulate_weighted(patches, linearization, weights);
}

}  // namespace sparsight
