#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "slam/tracking/photometric_alignment.h"
#include "slam/tracking/search_budget.h"

namespace sparsight {

// Patches at even steps through the set, `wanted` of them to twice as many. `out` keeps its memory.
void thin(const PatchSet& patches, std::size_t wanted, PatchSet& out);

// Where a starting motion leads in a few steps, and how well the patches are found there.
struct RankedStart {
  Alignment at;
  double found_share = 0.0;
};

// Sorts starting motions by what they promise, best first; those that see fewer than min_visible
// patches are left out, and so are, if there is a budget, the last when it is used up. Cheap: it
// serves to tell which are worth following. `ranked` keeps its memory.
void rank_starts(const std::vector<Alignment>& starts, const PatchSet& patches,
                 const GreyImage& image, const CameraModel& camera, double mean_inverse_depth,
                 double min_visible, const PhotometryConfig& photometry,
                 AlignmentWorkspace& workspace, std::vector<RankedStart>& ranked,
                 SearchBudget* budget = nullptr);

}  // namespace sparsight
