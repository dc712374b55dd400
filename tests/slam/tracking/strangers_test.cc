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
  std::vector<SelectedPoint> weighed(const GreyImage& earlier,
                                     const Eigen::Isometry3d& T_earlier_keyframe,
                                     bool in_traffic = false) const {
    std::vector<SelectedPoint> points = keyframe_.points;
    PatchSet patches = keyframe_.patches.front();
    weigh_down_strangers(points, patches, earlier, room_.camera(), T_earlier_keyframe, in_traffic);
    for (std::size_t i = 0; i < patches.patches * kPatternSize; ++i) {
      EXPECT_EQ(patches.weight[i],
                keyframe_.patches.front().weight[i] * points[i / kPatternSize].weight);
    }
    return points;
  }
  // Of the points that the earlier image shows left (right) of its middle.
  double share_weighed_down(const std::vector<SelectedPoint>& points, bool left) const {
    int all = 0;
    int down = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      Eigen::Vector2d pixel;
      const Eigen::Vector3d p = points[i].p_camera.cast<double>();
      if (!room_.camera().project(T_world_earlier_.inverse() * p, pixel)) continue;
      if (!room_.camera().contains(pixel, 4.0)) continue;
      if (std::abs(pixel.x() - 80.0) < 6.0 || (pixel.x() < 80.0) != left) continue;
      if (keyframe_.patches.front().weight[i * kPatternSize] <= 0.0F) continue;
      ++all;
      down += points[i].weight < 1.0F;
    }
    return static_cast<double>(down) / all;
  }

  const SineRoom room_{};
  const Keyframe keyframe_ = room_.keyframe(1, Eigen::Isometry3d::Identity());
  const Eigen::Isometry3d T_world_earlier_ = pose(0.01, -0.03, 0.02, 0.1, 0.0, -0.2);
};

TEST_F(StrangersTest, LeavesASceneThatStandsStillAsItIs) {
  const std::vector<SelectedPoint> points =
      weighed(room_.image(T_world_earlier_, {0.8, 10.0}), T_world_earlier_.inverse());
  EXPECT_LT(share_weighed_down(points, true), 0.02);
  EXPECT_LT(share_weighed_down(points, false), 0.02);
}

TEST_F(StrangersTest, InTrafficSoIsWhatIsNotSurelyFound) {
  const std::vector<SelectedPoint> points =
      weighed(earlier_with_a_stranger(), T_world_earlier_.inverse(), true);
  EXPECT_GT(share_weighed_down(points, true), 0.6);
  EXPECT_LT(share_weighed_down(points, false), 0.02);
}

TEST_F(StrangersTest, TakesWeightFromWhatTheEarlierImageDoesNotShow) {
  const std::vector<SelectedPoint> points =
      weighed(earlier_with_a_stranger(), T_world_earlier_.inverse());
  EXPECT_GT(share_weighed_down(points, true), 0.35) << "chance finds the others";
  EXPECT_LT(share_weighed_down(points, false), 0.02);
  for (const SelectedPoint& point : points) EXPECT_GT(point.weight, 0.0F) << "still a patch";
}

TEST_F(StrangersTest, KnowsNothingOfWhatTheEarlierImageCouldNotShow) {
  const Eigen::Isometry3d T_turned_away = pose(0.0, M_PI, 0.0, 0.0, 0.0, 0.0);
  for (const SelectedPoint& point : weighed(earlier_with_a_stranger(), T_turned_away)) {
    EXPECT_EQ(point.weight, 1.0F);
  }
}

}  // namespace
}  // namespace sparsight
