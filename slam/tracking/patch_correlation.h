#pragma once

#include "slam/tracking/photometric_kernel.h"

namespace sparsight {

// How well the patches are found in the image, whatever the brightness: the median over the
// textured visible patches of the normalised cross-correlation; 1 is a perfect match, 0 chance. 1
// if no patch has texture: nothing speaks against the pose.
struct PatchAgreement {
  double median_correlation = 1.0;
  int visible_patches = 0;  // their centre projects into the image
};

PatchAgreement patch_agreement(const PatchSet& patches, const Linearization& linearization,
                               const Brightness& brightness);

}  // namespace sparsight
