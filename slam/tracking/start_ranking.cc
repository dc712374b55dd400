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

void thin(const PatchSet& patches, std::size_t wanted, PatchSet& out) {
  const std::size_t step =
      std::max<std::size_t>(1, patches.patches / std::max<std::size_t>(1, wanted));
  out.patches = 0;
  for (std::vector<float>* column : {&out.x, &out.y, &out.z, &out.intensity, &out.weight}) {
    column->clear();
  }
  for (std::size_t patch = 0; patch < patches.patches; patch += step) {
    copy_patch(patches.x, patch, out.x);
    copy_patch(patches.y, patch, out.y);
    copy_patch(patches.z, patch, out.z);
    copy_patch(patches.intensity, patch, out.intensity);
    copy_patch(patches.weight, patch, out.weight);
    ++out.patches;
  }
  const std::size_t padded =
      (out.entries() + PatchSet::kBlock - 1) / PatchSet::kBlock * PatchSet::kBlock;
  for (std::vector<float>* column : {&out.x, &out.y, &out.intensity, &out.weight}) {
    column->resize(padded, 0.0F);
  }
  out.z.resize(padded, 1.0F);
}

void rank_starts(const std::vector<Alignment>& starts, const PatchSet& patches,
                 const GreyImage& image, const CameraModel& camera, double mean_inverse_depth,
                 double min_visible, const PhotometryConfig& photometry,
                 AlignmentWorkspace& workspace, std::vector<RankedStart>& ranked,
                 SearchBudget* budget) {
  ranked.clear();
  for (const Alignment& start : starts) {
    if (budget && !budget->allows(SearchBudget::Step::kRank)) break;
    const Alignment at = align(patches, image, camera, mean_inverse_depth, start, kFewSteps,
                               photometry, workspace, Information::kLeftOut);
    const PatchAgreement agreement = patch_agreement(patches, workspace.current, at.brightness);
    if (agreement.visible_patches < min_visible) continue;
    // Behind its equals; std::stable_sort would allocate.
    const auto worse = std::find_if(ranked.begin(), ranked.end(), [&](const RankedStart& other) {
      return other.found_share < agreement.found_share;
    });
    ranked.insert(worse, {at, agreement.found_share});
  }
}

}  // namespace sparsight
