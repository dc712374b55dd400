#include "slam/window_stage.h"

#include <gtest/gtest.h>

#include "tests/slam/room_rig.h"

namespace sparsight {
namespace {

// Two keyframes, of which so much was found, and what is known of them.
struct TwoKeyframes {
  TrackingReference reference;  // after the second
  Matrix6d information;         // on the step between them

  TwoKeyframes(bool weigh_down_rough, double found_share) {
    const RoomRig rig;
    OdometryConfig config = room_config();
    config.photometry.weigh_down_rough = weigh_down_rough;
    WindowStage stage(rig.calibration(), config);
    for (const int i : {0, 3}) {
      const SynchronizedFrame frame = rig.frame(i);
      TrackedFrame tracked;
      tracked.pyramid.assign(frame.grey, config.tracker.pyramid_levels);
      tracked.outcome.status = FrameOutcome::Status::kTracked;
      tracked.outcome.tracking.found_share = found_share;
      tracked.outcome.T_world_camera = rig.T_world_camera(i);
      tracked.outcome.tracking.T_keyframe_camera =
          rig.T_world_camera(0).inverse() * rig.T_world_camera(i);
      tracked.motion.restart(frame.exposure);
      EXPECT_TRUE(stage.accept(frame, tracked));
    }
    stage.optimize();
    stage.describe(reference);
    stage.finish();
    information = stage.take_retired().front().successor->information;
  }
};

TEST(WindowStage, TrustsRoughPointsLessInTheWindowAndFullyInTracking) {
  const TwoKeyframes fully(false, 0.95);
  const TwoKeyframes less(true, 0.95);
  EXPECT_LT(less.information.trace(), 0.98 * fully.information.trace());
  EXPECT_GT(less.information.trace(), 0.3 * fully.information.trace()) << "walls are planes";
  const auto& patches = less.reference.keyframe.patches;
  ASSERT_EQ(patches.size(), fully.reference.keyframe.patches.size());
  for (std::size_t level = 0; level < patches.size(); ++level) {
    const std::vector<float>& weight = patches[level].weight;
    ASSERT_EQ(weight.size(), fully.reference.keyframe.patches[level].weight.size());
    for (std::size_t i = 0; i < weight.size(); ++i) {
      ASSERT_FLOAT_EQ(weight[i], fully.reference.keyframe.patches[level].weight[i]);
    }
  }
}

TEST(WindowStage, TrustsEveryPointWhereStrangersMayFillTheImage) {
  const TwoKeyframes fully(false, 0.7);
  const TwoKeyframes in_traffic(true, 0.7);
  EXPECT_EQ(in_traffic.information, fully.information);
}

}  // namespace
}  // namespace sparsight
