#include "slam/tracking/strangers.h"

#include <cstddef>

#include "slam/tracking/patch_agreement.h"
#include "slam/tracking/photometric_kernel.h"

namespace sparsight {
namespace {

constexpr float kStrangersWeight = 0.1F;
constexpr double kMissing = 0.2;  // correlation

}  // namespace

void weigh_down_strangers(std::vector<SelectedPoint>& points, PatchSet& patches,
                          const GreyImage& earlier, const CameraModel& camera,
                          const Eigen::Isometry3d& T_earlier_keyframe, bool in_traffic) {
  Linearization linearization;
  const Brightness same;  // agreement does not depend on it
  linearize(patches, earlier, camera, T_earlier_keyframe, same, linearization);
  for (const std::size_t stranger :
       missing_patches(patches, linearization, same, in_traffic ? kFoundCorrelation : kMissing)) {
    points[stranger].weight *= kStrangersWeight;
    for (std::size_t pixel = 0; pixel < kPatternSize; ++pixel) {
      patches.weight[stranger * kPatternSize + pixel] *= kStrangersWeight;
    }
  }
}

}  // namespace sparsight
