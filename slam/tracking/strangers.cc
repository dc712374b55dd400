#include "slam/tracking/strangers.h"

#include <cstddef>

#include "slam/tracking/patch_agreement.h"
#include "slam/tracking/photometric_kernel.h"

namespace sparsight {
namespace {

constexpr float kStrangersWeight = 0.1F;

}  // namespace

void weigh_down_strangers(std::vector<PatchSet>& patches, const GreyImage& earlier,
                          const CameraModel& camera, const Eigen::Isometry3d& T_earlier_keyframe) {
  Linearization linearization;
  const Brightness same;  // agreement does not depend on it
  linearize(patches.front(), earlier, camera, T_earlier_keyframe, same, linearization);
  for (const std::size_t stranger : missing_patches(patches.front(), linearization, same)) {
    for (PatchSet& level : patches) {
      for (std::size_t i = stranger * kPatternSize; i < (stranger + 1) * kPatternSize; ++i) {
        level.weight[i] *= kStrangersWeight;
      }
    }
  }
}

}  // namespace sparsight
