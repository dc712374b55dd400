#pragma once

#include <cstddef>
#include <vector>

#include "slam/tracking/photometric_kernel.h"

namespace sparsight {

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

// The textured visible patches that the image does not show at all.
std::vector<std::size_t> missing_patches(const PatchSet& patches,
                                         const Linearization& linearization,
                                         const Brightness& brightness);

}  // namespace sparsight
