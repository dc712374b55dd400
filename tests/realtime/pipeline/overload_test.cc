#include "realtime/pipeline/overload.h"

#include <gtest/gtest.h>

#include <vector>

#include "realtime/pipeline/anchored_trajectory.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;

// The rungs seen in looks a tenth of a second apart.
std::vector<Shed> rungs(const OverloadSigns& signs, int busy_looks, int calm_looks = 0) {
  OverloadLadder ladder;
  HostTime now(1000s);
  std::vector<Shed> result;
  for (int i = 0; i < busy_looks + calm_looks; ++i, now += 100ms) {
    const Shed rung = ladder.look(now, i < busy_looks ? signs : OverloadSigns{});
    if (result.empty() || result.back() != rung) result.push_back(rung);
  }
  return result;
}

TEST(OverloadLadder, LeavesOutNothingWhileNobodyIsBehind) {
  EXPECT_EQ(rungs({}, 50), std::vector{Shed::kNothing});
}

TEST(OverloadLadder, LeavesOutInTheOrderOfTheDesignUpToTheStageThatIsBehind) {
  const std::vector all{Shed::kPreview, Shed::kLoopSearch, Shed::kWindowIterations,
                        Shed::kTrackingLevels};
  EXPECT_EQ(rungs({.tracking = true}, 10), all);
  EXPECT_EQ(rungs({.window = true}, 10), std::vector(all.begin(), all.begin() + 3));
  EXPECT_EQ(rungs({.background = true}, 10), std::vector(all.begin(), all.begin() + 2));
  EXPECT_EQ(rungs({.background = true, .tracking = true}, 10), all);
}

TEST(OverloadLadder, ComesDownRungByRungOnceAllHaveCaughtUp) {
  const std::vector expected{Shed::kPreview,    Shed::kLoopSearch, Shed::kWindowIterations,
                             Shed::kLoopSearch, Shed::kPreview,    Shed::kNothing};
  EXPECT_EQ(rungs({.window = true}, 5, 100), expected);
  EXPECT_EQ(rungs({.window = true}, 5, 15).back(), Shed::kWindowIterations) << "not at once";
}

TEST(AnchoredTrajectory, PlacesFramesAtTheFinalPosesOfTheirKeyframes) {
  AnchoredTrajectory trajectory;
  FrameOutcome outcome;
  outcome.keyframe_sequence = 3;
  outcome.tracking.T_keyframe_camera.translation() = Eigen::Vector3d(0.0, 0.0, 1.0);
  trajectory.add(4, HostTime(1s), outcome);
  trajectory.settle(3, Eigen::Isometry3d(Eigen::Translation3d(5.0, 0.0, 0.0)));
  const auto poses = trajectory.poses();
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].sequence, 4U);
  EXPECT_EQ(poses[0].T_world_camera.translation(), Eigen::Vector3d(5.0, 0.0, 1.0));
}

}  // namespace
}  // namespace sparsight
