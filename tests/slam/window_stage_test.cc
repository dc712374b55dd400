#include "slam/window_stage.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/image/interpolation.h"
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

// What tracking is given must be of one camera: each patch then shows what stands where that camera
// projects it.
void expect_seen_through_its_camera(const TrackingReference& reference, const ImagePyramid& image) {
  for (int level = 0; level < image.levels(); ++level) {
    const PatchSet& set = reference.keyframe.patches[static_cast<std::size_t>(level)];
    const CameraModel camera = reference.camera.at_level(level);
    double squares = 0.0;
    int seen = 0;
    for (std::size_t i = 0; i < set.patches * kPatternSize; i += kPatternSize) {
      Eigen::Vector2d pixel;
      if (set.weight[i] <= 0.0F) continue;
      ASSERT_TRUE(camera.project(Eigen::Vector3d(set.x[i], set.y[i], set.z[i]), pixel));
      const float grey = sample_value(image.level(level), static_cast<float>(pixel.x()),
                                      static_cast<float>(pixel.y()));
      squares += std::pow(grey - set.intensity[i], 2);
      ++seen;
    }
    ASSERT_GT(seen, 50);
    EXPECT_LT(std::sqrt(squares / seen), 1e-3) << "level " << level;
  }
}

TEST(WindowStage, TakesALearnedCameraOverAsAWhole) {
  RoomRig rig;
  rig.turn_rad_s = 0.3;
  RigCalibration given = rig.calibration();
  given.camera.fx *= 1.01;
  given.camera.fy *= 1.01;
  OdometryConfig config = room_config();
  config.self_calibration = {
      .enabled = true, .focal_sigma = 0.02, .k1_sigma = 0.05, .believed_share = 0.2};
  WindowStage stage(given, config);
  TrackingReference reference;
  int cameras = 0;
  for (int i = 0; i < 24; i += 3) {
    const SynchronizedFrame frame = rig.frame(i);
    TrackedFrame tracked;
    tracked.pyramid.assign(frame.grey, config.tracker.pyramid_levels);
    tracked.outcome.status = FrameOutcome::Status::kTracked;
    tracked.outcome.tracking.found_share = 0.95;
    tracked.outcome.T_world_camera = rig.T_world_camera(i);
    tracked.motion.restart(frame.exposure);
    const double focal = stage.camera().fx;
    ASSERT_TRUE(stage.accept(frame, tracked));
    cameras += stage.camera().fx != focal;
    stage.optimize();
    stage.describe(reference);
    expect_seen_through_its_camera(reference, tracked.pyramid);
  }
  EXPECT_GE(cameras, 3) << "learned of none, and nothing was tested";
  EXPECT_LT(std::abs(stage.camera().fx / rig.room.intrinsics.fx - 1.0), 0.005);
}

}  // namespace
}  // namespace sparsight
