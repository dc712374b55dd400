#include <gtest/gtest.h>

#include "drivers/simulated/lens.h"
#include "drivers/simulated/simulated_rig.h"

namespace sparsight::simulated {
namespace {

TEST(SimulatedLens, UnprojectsWhatItProjects) {
  const CameraIntrinsics camera = simulated_rig_config({}).calibration.camera;
  ASSERT_TRUE(camera.distorted());
  for (double v = 0.0; v < camera.height; v += 37.0) {
    for (double u = 0.0; u < camera.width; u += 41.0) {
      EXPECT_LT((project(camera, unproject(camera, {u, v})) - Eigen::Vector2d(u, v)).norm(), 1e-6);
    }
  }
}

TEST(SimulatedLens, RectifiedHasNone) {
  SimulationOptions options;
  options.lens = SimulatedLens::kRectified;
  EXPECT_FALSE(simulated_rig_config(options).calibration.camera.distorted());
}

}  // namespace
}  // namespace sparsight::simulated
