#include "realtime/pipeline/anchored_trajectory.h"

#include <gtest/gtest.h>

namespace sparsight {
namespace {

using Status = FrameOutcome::Status;

Eigen::Isometry3d at(double x) { return Eigen::Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)); }

// A frame every tenth of a second, `x` metres from its keyframe.
class Path {
 public:
  void frame(Status status, bool in_question, double x, std::uint64_t keyframe) {
    FrameOutcome outcome{.status = status, .keyframe_sequence = keyframe};
    outcome.in_question = in_question;
    outcome.tracking.T_keyframe_camera = at(x);
    trajectory.add(next_, HostTime(std::chrono::milliseconds(100) * static_cast<long>(next_)),
                   outcome);
    ++next_;
  }

  AnchoredTrajectory trajectory;

 private:
  std::uint64_t next_ = 0;
};

TEST(AnchoredTrajectory, AFrameThatWasPredictedForAMomentKeepsItsPlace) {
  Path path;
  path.frame(Status::kFirst, false, 0.0, 0);
  path.frame(Status::kPredicted, true, 0.1, 0);
  path.frame(Status::kTracked, false, 0.2, 0);
  path.trajectory.settle(0, at(5.0));
  const auto poses = path.trajectory.poses();
  for (const TrajectoryPose& pose : poses) EXPECT_TRUE(pose.known) << pose.sequence;
  EXPECT_DOUBLE_EQ(poses[1].T_world_camera.translation().x(), 5.1);
}

TEST(AnchoredTrajectory, WhatWasInQuestionWhenTrackingWasLostHasNoPlace) {
  Path path;
  path.frame(Status::kFirst, false, 0.0, 0);
  path.frame(Status::kTracked, false, 0.1, 0);
  path.frame(Status::kPredicted, true, 0.2, 0);
  path.frame(Status::kTracked, true, 7.0, 0);  // a look-alike
  path.frame(Status::kLost, true, 0.4, 0);
  path.frame(Status::kLost, true, 0.4, 0);  // with it a sub-map begins
  path.frame(Status::kTracked, false, 0.1, 5);
  path.trajectory.settle(0, at(5.0));
  path.trajectory.settle(5, at(9.0));
  const auto poses = path.trajectory.poses();
  const std::vector<bool> known{true, true, false, false, false, true, true};
  for (std::size_t i = 0; i < known.size(); ++i) {
    EXPECT_EQ(poses[i].known, known[i]) << i;
    if (!known[i]) {
      EXPECT_DOUBLE_EQ(poses[i].T_world_camera.translation().x(), 5.1) << "the last that was";
    }
  }
  EXPECT_DOUBLE_EQ(poses[5].T_world_camera.translation().x(), 9.0);
  EXPECT_DOUBLE_EQ(poses[6].T_world_camera.translation().x(), 9.1);
}

}  // namespace
}  // namespace sparsight
