#include "slam/tracking/robust_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace sparsight {
namespace {

struct PatchSum {
  double squares = 0.0;  // sum of w r^2
  double pixels = 0.0;   // sum of w
};

PatchSum sum_of_patch(const Linearization& l, std::size_t first) {
  float squares = 0.0F;
  float pixels = 0.0F;
  for (std::size_t i = first; i < first + kPatternSize; ++i) {
    squares += l.weight[i] * l.residual[i] * l.residual[i];
    pixels += l.weight[i];
  }
  return {.squares = static_cast<double>(squares), .pixels = static_cast<double>(pixels)};
}

std::vector<PatchSum> patch_sums(const Linearization& l) {
  std::vector<PatchSum> sums;
  sums.reserve(l.residual.size() / kPatternSize);
  for (std::size_t first = 0; first + kPatternSize <= l.residual.size(); first += kPatternSize) {
    sums.push_back(sum_of_patch(l, first));
  }
  return sums;
}

double patch_weight(const PatchSum& patch, double dof, double sigma2) {
  return (dof + patch.pixels) / (dof + patch.squares / sigma2);
}

double total_pixels(const std::vector<PatchSum>& patches) {
  double pixels = 0.0;
  for (const PatchSum& patch : patches) pixels += patch.pixels;
  return pixels;
}

}  // namespace

double estimate_sigma(const Linearization& linearization, const PhotometryConfig& photometry,
                      double sigma_start) {
  if (!photometry.patch_weights) {
    return estimate_sigma(linearization, photometry.student_t_dof, sigma_start);
  }
  constexpr int kMaxIterations = 30;
  constexpr double kRelativeTolerance = 1e-3;
  const std::vector<PatchSum> patches = patch_sums(linearization);
  const double pixels = total_pixels(patches);
  double sigma = std::max(sigma_start, kMinSigma);
  if (pixels <= 0.0) return sigma;
  for (int i = 0; i < kMaxIterations; ++i) {
    double squares = 0.0;
    for (const PatchSum& patch : patches) {
      squares += patch_weight(patch, photometry.student_t_dof, sigma * sigma) * patch.squares;
    }
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
  double cost = 0.0;
  double pixels = 0.0;
  for (const PatchSum& patch : patch_sums(linearization)) {
    cost += 0.5 * (dof + patch.pixels) * std::log1p(patch.squares / (dof * sigma * sigma));
    pixels += patch.pixels;
  }
  return pixels > 0.0 ? sigma * sigma * cost / pixels : std::numeric_limits<double>::infinity();
}

NormalEquations accumulate(const PatchSet& patches, const Linearization& linearization,
                           const PhotometryConfig& photometry, double sigma) {
  if (!photometry.patch_weights) {
    return accumulate(patches, linearization, photometry.student_t_dof, sigma);
  }
  std::vector<float> weights = linearization.weight;
  for (std::size_t first = 0; first + kPatternSize <= weights.size(); first += kPatternSize) {
    const auto weight = static_cast<float>(
        patch_weight(sum_of_patch(linearization, first), photometry.student_t_dof, sigma * sigma));
    for (std::size_t i = first; i < first + kPatternSize; ++i) weights[i] *= weight;
  }
  return accumulate_weighted(patches, linearization, weights);
}

}  // namespace sparsight
