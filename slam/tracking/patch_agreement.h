#pragma once

#include <cstddef>
#include <vector>

#include "slam/tracking/photometric_kernel.h"

namespace sparsight {

inline constexpr double kFoundCorrelation = 0.7;

// How much of the keyframe is found in the image, whatever the brightness: the share of the
// textured visible patches whose normalised cross-correlation with the image is high. A share and
// not a mean: cars that fill half the image do not make the other half wrong. 0 if no patch has
// texture: nothing speaks for the pose, as of a keyframe taken in the dark.
struct PatchAgreement {
  double found_share = 0.0;
  int visible_patches = 0;  // their centre projects into the image
};

PatchAgreement patch_agreement(const PatchSet& patches, const Linearization& linearization,
                               const Brightness& brightness);

// The textured visible patches whose correlation with the image is below that: those it does not
// show at all have less than 0.2, those that are found kFoundCorrelation.
std::vector<std::size_t> missing_patches(const PatchSet& patches,
                                         const Linearization& linearization,
                                         const Brightness& brightness, double below);

}  // namespace sparsight
