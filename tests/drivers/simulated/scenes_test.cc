#include "drivers/simulated/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/simulated/walk.h"
#include "drivers/simulated/world.h"

namespace sparsight::simulated {
namespace {

class EveryScene : public ::testing::TestWithParam<SimulatedScene> {
 protected:
  static SimulationOptions coarse() {
    SimulationOptions options;
    options.scene = GetParam();
    options.light_detail = 0.1;
    return options;
  }
};

TEST_P(EveryScene, HasRoomForTheWalk) {
  const World world(make_scene(coarse()));
  const Walk walk(world.scene().walk, 1);
  const double lap_s = walk.lap_m() / world.scene().walk.speed_m_s;
  double nearest = 1e9;
  for (double t = 0.0; t < lap_s; t += 0.1) {
    const Eigen::Isometry3d T_world_lidar = walk.lidar_pose(t);
    for (int i = 0; i < 12; ++i) {
      const double angle = i * M_PI / 6;
      const Hit hit =
          world.cast({T_world_lidar.translation().cast<float>(),
                      Eigen::Vector3d(std::cos(angle), std::sin(angle), 0).cast<float>()});
      if (hit.any()) nearest = std::min(nearest, static_cast<double>(hit.distance));
    }
  }
  EXPECT_GT(nearest, 0.45);
}

TEST_P(EveryScene, IsMadeOfFlatPanelsThatAreNotGigantic) {
  const Scene scene = make_scene(coarse());
  EXPECT_GT(scene.panels.size(), 500U);
  for (const Panel& panel : scene.panels) {
    const Eigen::Vector3f normal = panel.normal();
    ASSERT_NEAR(normal.norm(), 1.0F, 1e-4F);
    for (const Eigen::Vector3f& corner : panel.corners) {
      EXPECT_LT(std::abs((corner - panel.corners[0]).dot(normal)), 0.02F);
      EXPECT_LT(corner.norm(), 80.0F);
    }
    EXPECT_LT(static_cast<std::size_t>(panel.material), scene.library.materials.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Simulated, EveryScene,
                         ::testing::Values(SimulatedScene::kCorridor, SimulatedScene::kHall,
                                           SimulatedScene::kStreet));

}  // namespace
}  // namespace sparsight::simulated
