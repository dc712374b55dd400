#pragma once

#include "slam/tracking/patch_set.h"

namespace sparsight {

// Standard deviation, in grey levels, from which a patch has texture: above what noise makes of a
// lens that is covered.
inline constexpr double kTextureGrey = 4.0;

// The patches that an image can be found by.
int textured_patches(const PatchSet& patches);

}  // namespace sparsight
