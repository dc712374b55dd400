#include "slam/tracking/start_ranking.h"

#include <algorithm>

#include "slam/tracking/patch_agreement.h"

namespace sparsight {
namespace {

// Enough to leave a wrong start behind or to show that it is wrong.
constexpr AlignmentConfig kFewSteps{.max_iterations = 15, .convergence_px = 0.1};

void copy_patch(const std::vector<float>& from, std::size_t patch, std::vector<float>& to) {
  const auto first = from.begin() + static_cast<std::ptrdiff_t>(patch * kPatternSize);
  to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(kPatternSize));
}

}  // namespace

PatchSet thinned(const PatchSet& patches, std::size_t wanted) {
  const std::size_t step =
      std::max<std::size_t>(1, patches.patches / std::max<std::size_t>(1, wanted));
  PatchSet result;
  for (std::size_t patch = 0; patch < patches.patches; patch += step) {
    copy_patch(patches.x, patch, result.x);
    copy_patch(patches.y, patch, result.y);
    copy_patch(patches.z, patch, result.z);
    copy_patch(patches.intensity, patch, result.intensity);
    copy_patch(patches.weight, patch, result.weight);
    ++result.patches;
  }
  const std::size_t padded =
      (result.entries() + PatchSet::kBlock - 1) / PatchSet::kBlock * PatchSet::kBlock;
  for (std::vector<float>* column : {&result.x, &result.y, &result.intensity, &result.weight}) {
    column->resize(padded, 0.0F);
  }
  result.z.resize(padded, 1.0F);
  return result;
}

std::vector<RankedStart> rank_starts(const std::vector<Alignment>& starts, const PatchSet& patches,
                                     const GreyImage& image, const CameraModel& camera,
                                     double mean_inverse_depth, double min_visible,
                                     const PhotometryConfig& photometry,
                                     AlignmentWorkspace& workspace) {
  std::vector<RankedStart> ranked;
  for (const Alignment& start : starts) {
    const Alignment at =
        align(patches, image, camera, mean_inverse_depth, start, kFewSteps, photometry, workspace);
    const PatchAgreement agreement = patch_agreement(patches, workspace.current, at.brightness);
    if (agreement.visible_patches < min_visible) continue;
    ranked.push_back({at, agreement.found_share});
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const RankedStart& a, const RankedStart& b) {
    return a.found_share > b.found_share;
  });
  return ranked;
}

}  // namespace sparsight
