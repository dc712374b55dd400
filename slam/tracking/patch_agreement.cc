#include "slam/tracking/patch_agreement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "slam/tracking/patch_texture.h"

namespace sparsight {
namespace {

struct Moments {
  double n = 0.0, a = 0.0, b = 0.0, aa = 0.0, bb = 0.0, ab = 0.0;

  void add(double x, double y) {
    n += 1.0;
    a += x;
    b += y;
    aa += x * x;
    bb += y * y;
    ab += x * y;
  }
  double variance_a() const { return aa / n - a * a / (n * n); }
  double variance_b() const { return bb / n - b * b / (n * n); }
  double correlation() const {
    const double covariance = ab / n - a * b / (n * n);
    return covariance / std::sqrt(std::max(variance_a() * variance_b(), 1e-9));
  }
};

bool is_visible(const Linearization& linearization, std::size_t patch) {
  return linearization.weight[patch * kPatternSize] > 0.0F;  // the pattern's first pixel
}

// Nothing of a patch without texture.
std::optional<double> correlation(const PatchSet& patches, const Linearization& linearization,
                                  const Brightness& brightness, std::size_t patch) {
  Moments m;
  const std::size_t first = patch * kPatternSize;
  for (std::size_t i = first; i < first + kPatternSize; ++i) {
    if (linearization.weight[i] <= 0.0F) continue;
    const double reference = patches.intensity[i];
    m.add(reference, linearization.residual[i] + brightness.gain * reference + brightness.offset);
  }
  if (m.variance_a() < kTextureGrey * kTextureGrey) return std::nullopt;
  return m.correlation();
}

}  // namespace

PatchAgreement patch_agreement(const PatchSet& patches, const Linearization& linearization,
                               const Brightness& brightness) {
  PatchAgreement result;
  int textured = 0;
  int found = 0;
  for (std::size_t patch = 0; patch < patches.patches; ++patch) {
    if (!is_visible(linearization, patch)) continue;
    ++result.visible_patches;
    const std::optional<double> match = correlation(patches, linearization, brightness, patch);
    if (!match) continue;
    ++textured;
    if (*match >= kFoundCorrelation) ++found;
  }
  if (textured > 0) result.found_share = static_cast<double>(found) / textured;
  return result;
}

std::vector<std::size_t> missing_patches(const PatchSet& patches,
                                         const Linearization& linearization,
                                         const Brightness& brightness, double below) {
  std::vector<std::size_t> missing;
  for (std::size_t patch = 0; patch < patches.patches; ++patch) {
    if (!is_visible(linearization, patch)) continue;
    const std::optional<double> match = correlation(patches, linearization, brightness, patch);
    if (match && *match < below) missing.push_back(patch);
  }
  return missing;
}

}  // namespace sparsight
