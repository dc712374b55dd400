#include "slam/tracking/strangers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/slam/sine_room.h"

namespace sparsight {
namespace {

class StrangersTest : public testing::Test {
 protected:
  // Something else fills the left of the earlier image.
  GreyImage earlier_with_a_stranger() const {
    SineRoom other = room_;
    other.pattern = 4;
    GreyImage image = room_.image(T_world_earlier_);
    const GreyImage elsewhere = other.image(T_world_earlier_);
    for (int v = 0; v < image.height; ++v) {
      const auto row = static_cast<std::ptrdiff_t>(v) * image.width;
      std::copy_n(elsewhere.pixels.begin() + row, image.width / 2, image.pixels.begin() + row);
    }
    return image;
  }
  std::vector<PatchSet> weighed(const GreyImage& earlier) const {
    std::vector<PatchSet> patches = keyframe_.patches;
    weigh_down_strangers(patches, earlier, room_.camera(), T_world_earlier_.inverse());
    return patches;
  }
  // Of the patches whose point the earlier image shows left (right) of its middle.
  double share_weighed_down(const std::vector<PatchSet>& patches, std::size_t level,
                            bool left) const {
    int all = 0;
    int down = 0;
    for (std::size_t i = 0; i < keyframe_.points.size(); ++i) {
      Eigen::Vector2d pixel;
      const Eigen::Vector3d p = keyframe_.points[i].p_camera.cast<double>();
      if (!room_.camera().project(T_world_earlier_.inverse() * p, pixel)) continue;
      if (!room_.camera().contains(pixel, 4.0)) continue;
      if (std::abs(pixel.x() - 80.0) < 6.0 || (pixel.x() < 80.0) != left) continue;
      const std::size_t entry = i * kPatternSize;
      if (keyframe_.patches[level].weight[entry] <= 0.0F) continue;
      ++all;
      down += patches[level].weight[entry] < keyframe_.patches[level].weight[entry];
    }
    return static_cast<double>(down) / all;
  }

  const SineRoom room_{};
  const Keyframe keyframe_ = room_.keyframe(1, Eigen::Isometry3d::Identity());
  const Eigen::Isometry3d T_world_earlier_ = pose(0.01, -0.03, 0.02, 0.1, 0.0, -0.2);
};

TEST_F(StrangersTest, LeavesASceneThatStandsStillAsItIs) {
  const std::vector<PatchSet> patches = weighed(room_.image(T_world_earlier_, {0.8, 10.0}));
  EXPECT_LT(share_weighed_down(patches, 0, true), 0.02);
  EXPECT_LT(share_weighed_down(patches, 0, false), 0.02);
}

TEST_F(StrangersTest, TakesWeightFromWhatTheEarlierImageDoesNotShow) {
  const std::vector<PatchSet> patches = weighed(earlier_with_a_stranger());
  for (const std::size_t level : {0U, 1U, 2U}) {
    EXPECT_GT(share_weighed_down(patches, level, true), 0.35) << level;  // chance finds the others
    EXPECT_LT(share_weighed_down(patches, level, false), 0.02) << level;
    for (const float weight : patches[level].weight) EXPECT_GE(weight, 0.0F);
    EXPECT_EQ(std::count(patches[level].weight.begin(), patches[level].weight.end(), 0.0F),
              std::count(keyframe_.patches[level].weight.begin(),
                         keyframe_.patches[level].weight.end(), 0.0F))
        << "a stranger is still a patch";
  }
}

TEST_F(StrangersTest, KnowsNothingOfWhatTheEarlierImageCouldNotShow) {
  std::vector<PatchSet> patches = keyframe_.patches;
  const Eigen::Isometry3d T_turned_away = pose(0.0, M_PI, 0.0, 0.0, 0.0, 0.0);
  weigh_down_strangers(patches, earlier_with_a_stranger(), room_.camera(), T_turned_away);
  EXPECT_EQ(patches.front().weight, keyframe_.patches.front().weight);
}

}  // namespace
}  // namespace sparsight
