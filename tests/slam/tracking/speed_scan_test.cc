#include "slam/tracking/speed_scan.h"

#include <gtest/gtest.h>

#include "tests/slam/sine_room.h"

namespace sparsight {
namespace {

class SpeedScanTest : public testing::Test {
 protected:
  // From where the estimate stands, as a share of the way.
  std::optional<Alignment> scan(double share, const Eigen::Vector3d& way,
                                bool anything_goes = true) const {
    Alignment found;
    found.T_camera_keyframe = Eigen::Isometry3d(Eigen::Translation3d(-share * way));
    AlignmentWorkspace workspace;
    const GreyImage image = room_.image(Eigen::Isometry3d(Eigen::Translation3d(way)));
    found = assess(keyframe_.patches.front(), image, room_.camera(), found, {}, workspace);
    return best_speed(
        keyframe_.patches.front(), image, room_.camera(), keyframe_.mean_inverse_depth, found, way,
        [=](const Eigen::Isometry3d&) { return anything_goes; }, {}, workspace);
  }
  double share_of(const Alignment& at) const {
    return at.T_camera_keyframe.inverse().translation().z() / fast_.z();
  }

  const SineRoom room_{};
  const Keyframe keyframe_ = room_.keyframe(0, Eigen::Isometry3d::Identity());
  const Eigen::Vector3d fast_{0.0, 0.0, 2.5};
  const Eigen::Vector3d slow_{0.0, 0.0, 0.5};
};

TEST_F(SpeedScanTest, FindsTheSpeedThatFitsBest) {
  for (const double share : {0.82, 0.9, 1.1, 1.18}) {
    const std::optional<Alignment> best = scan(share, fast_);
    ASSERT_TRUE(best) << share;
    EXPECT_NEAR(share_of(*best), 1.0, 0.034) << share;  // half a step
  }
}

TEST_F(SpeedScanTest, HasNothingBetterThanTheTruth) { EXPECT_FALSE(scan(1.0, fast_)); }

TEST_F(SpeedScanTest, StaysNear) {
  const std::optional<Alignment> best = scan(0.5, fast_);
  EXPECT_LE(best ? share_of(*best) : 0.5, 0.7 + 1e-9);
}

TEST_F(SpeedScanTest, LeavesSlowFramesAlone) { EXPECT_FALSE(scan(0.9, slow_)); }

TEST_F(SpeedScanTest, TakesNothingImplausible) { EXPECT_FALSE(scan(0.9, fast_, false)); }

}  // namespace
}  // namespace sparsight
