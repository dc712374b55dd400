#include "slam/tracking/robust_model.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sparsight {
namespace {

using Sums = Eigen::Map<const Eigen::ArrayXd>;

Sums array_of(const std::vector<double>& sums) {
  return {sums.data(), static_cast<Eigen::Index>(sums.size())};
}

}  // namespace

double estimate_sigma(const Linearization& linearization, const PhotometryConfig& photometry,
                      double sigma_start) {
  if (!photometry.patch_weights) {
    return estimate_sigma(linearization, photometry.student_t_dof, sigma_start);
  }
  constexpr int kMaxIterations = 30;
  constexpr double kRelativeTolerance = 1e-3;
  const Sums squares = array_of(linearization.patch_squares);
  const Sums pixels = array_of(linearization.patch_pixels);
  const double dof = photometry.student_t_dof;
  const double all = pixels.sum();
  double sigma = std::max(sigma_start, kMinSigma);
  if (all <= 0.0) return sigma;
  for (int i = 0; i < kMaxIterations; ++i) {
    const double weighted = ((dof + pixels) / (dof + squares / (sigma * sigma)) * squares).sum();
    const double updated = std::max(std::sqrt(weighted / all), kMinSigma);
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
  const double pixels = array_of(linearization.patch_pixels).sum();
  if (pixels <= 0.0) return std::numeric_limits<double>::infinity();
  const double cost = patch_log_sum(linearization, dof, 1.0 / (dof * sigma * sigma));
  return 0.5 * sigma * sigma * cost / pixels;
}

NormalEquations accumulate(const PatchSet& patches, const Linearization& linearization,
                           const PhotometryConfig& photometry, double sigma) {
  if (!photometry.patch_weights) {
    return accumulate(patches, linearization, photometry.student_t_dof, sigma);
  }
  const double dof = photometry.student_t_dof;
  std::vector<float>& weights = linearization.robust_weight;
  weights.resize(linearization.weight.size());
  for (std::size_t first = 0; first < weights.size(); first += kPatternSize) {
    const std::size_t patch = first / kPatternSize;
    const double weight = (dof + linearization.patch_pixels[patch]) /
                          (dof + linearization.patch_squares[patch] / (sigma * sigma));
    for (std::size_t i = first; i < first + kPatternSize; ++i) {
      weights[i] = linearization.weight[i] * static_cast<float>(weight);
    }
  }
  return accumulate_weighted(patches, linearization, weights);
}

}  // namespace sparsight
