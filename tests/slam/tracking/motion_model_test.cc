#include "slam/tracking/motion_model.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/slam/random_values.h"

namespace sparsight {
namespace {

HostTime at(double seconds) {
  return HostTime(std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9)));
}

double distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.matrix() - b.matrix()).norm();
}

TEST(MotionModel, ExpectsNothingToMoveBeforeItHasSeenMotion) {
  MotionModel model;
  EXPECT_EQ(distance(model.predict_in_keyframe(at(5.0)), Eigen::Isometry3d::Identity()), 0.0);
  const Eigen::Isometry3d T = exp_se3(Vector6d::Constant(0.1));
  model.observe(at(1.0), T);
  EXPECT_FALSE(model.twist().has_value());
  EXPECT_EQ(distance(model.predict_in_keyframe(at(5.0)), T), 0.0);
}

RC_GTEST_PROP(MotionModel, ContinuesAConstantTwistOverUnevenTimes, ()) {
  const Vector6d twist = any_increment(2.0, 20.0);
  MotionModel model;
  model.observe(at(10.0), exp_se3(twist * 0.0));
  model.observe(at(10.1), exp_se3(twist * 0.1));
  model.observe(at(10.35), exp_se3(twist * 0.35));
  RC_ASSERT((*model.twist() - twist).norm() < 1e-6);
  RC_ASSERT(distance(model.predict_in_keyframe(at(10.5)), exp_se3(twist * 0.5)) < 1e-6);
}

TEST(MotionModel, KeepsItsVelocityWhenAPoseIsInDoubt) {
  const Vector6d twist = 0.5 * Vector6d::Ones();
  MotionModel model;
  model.observe(at(0.0), exp_se3(twist * 0.0));
  model.observe(at(0.1), exp_se3(twist * 0.1), true);
  ASSERT_TRUE(model.twist()) << "a doubtful velocity is better than none";
  const Eigen::Isometry3d T_doubtful = exp_se3(-twist * 0.3);
  model.observe(at(0.2), T_doubtful, true);
  EXPECT_LT((*model.twist() - twist).norm(), 1e-9);
  EXPECT_LT(distance(model.last_in_keyframe(), T_doubtful), 1e-12);
  model.observe(at(0.3), T_doubtful * exp_se3(-twist * 0.1));
  EXPECT_LT((*model.twist() + twist).norm(), 1e-9);
}

TEST(MotionModel, GoesOnAcrossANewKeyframe) {
  Vector6d twist;
  twist << 0.0, 0.3, 0.0, 0.0, 0.0, 8.0;
  MotionModel model;
  model.observe(at(0.0), Eigen::Isometry3d::Identity());
  model.observe(at(0.1), exp_se3(twist * 0.1));
  model.rebase(at(0.1));
  EXPECT_LT(distance(model.predict_in_keyframe(at(0.2)), exp_se3(twist * 0.1)), 1e-9);
  model.observe(at(0.2), exp_se3(twist * 0.1));
  EXPECT_LT((*model.twist() - twist).norm(), 1e-9);
}

// A keyframe may be made of a frame that could not be tracked: nothing was observed since.
TEST(MotionModel, StartsFromAKeyframeThatWasNotObserved) {
  Vector6d twist;
  twist << 0.0, 0.3, 0.0, 0.0, 0.0, 8.0;
  MotionModel model;
  model.observe(at(0.0), Eigen::Isometry3d::Identity());
  model.observe(at(0.1), exp_se3(twist * 0.1));
  model.rebase(at(0.5));
  EXPECT_LT(distance(model.predict_in_keyframe(at(0.6)), exp_se3(twist * 0.1)), 1e-9);
  model.observe(at(0.6), exp_se3(twist * 0.1));
  EXPECT_LT((*model.twist() - twist).norm(), 1e-9);
}

// The window's word on a keyframe comes when frames after it have been tracked already.
TEST(MotionModel, GoesOverToAKeyframeThatLiesFramesBack) {
  Vector6d twist;
  twist << 0.0, 0.3, 0.0, 0.0, 0.0, 8.0;
  MotionModel model;
  for (const double t : {0.0, 0.1, 0.2, 0.3}) model.observe(at(t), exp_se3(twist * t));
  model.rebase(at(0.1));
  EXPECT_LT(distance(model.last_in_keyframe(), exp_se3(twist * 0.2)), 1e-9);
  EXPECT_LT(distance(model.predict_in_keyframe(at(0.4)), exp_se3(twist * 0.3)), 1e-9);
  EXPECT_LT(distance(model.at(at(0.1)), Eigen::Isometry3d::Identity()), 1e-9);
  EXPECT_NEAR(*model.seconds_since_last(at(0.4)), 0.1, 1e-9);
}

TEST(MotionModel, KeepsItsVelocityWhereTimeDoesNotAdvance) {
  Vector6d twist;
  twist << 0.0, 0.0, 0.1, 1.0, 0.0, 0.0;
  MotionModel model;
  model.observe(at(0.0), Eigen::Isometry3d::Identity());
  model.observe(at(0.1), exp_se3(twist * 0.1));
  model.observe(at(0.1), exp_se3(twist * 0.2));
  EXPECT_LT((*model.twist() - twist).norm(), 1e-9);
  EXPECT_TRUE(model.predict_in_keyframe(at(0.05)).matrix().allFinite());
}

// What moves the LiDAR's returns: not one velocity for all, where it is known better.
TEST(MotionModel, RemembersWhereTheCameraWasBetweenFrames) {
  Vector6d there;
  there << 0.0, 0.4, 0.0, 0.0, 0.0, 1.0;
  Vector6d back;
  back << 0.0, -0.4, 0.0, 0.0, 0.0, 1.0;
  MotionModel model;
  model.observe(at(0.0), Eigen::Isometry3d::Identity());
  const Eigen::Isometry3d T_turn = exp_se3(there * 0.1);
  model.observe(at(0.1), T_turn);
  model.observe(at(0.2), T_turn * exp_se3(back * 0.1));
  EXPECT_LT(distance(model.at(at(0.05)), exp_se3(there * 0.05)), 1e-9);
  EXPECT_LT(distance(model.at(at(0.15)), T_turn * exp_se3(back * 0.05)), 1e-9);
  EXPECT_LT(distance(model.at(at(0.25)), T_turn * exp_se3(back * 0.15)), 1e-9) << "goes on";

  const Eigen::Isometry3d T_between = model.at(at(0.15)).inverse() * model.at(at(0.05));
  model.rebase(at(0.2));
  EXPECT_LT(distance(model.at(at(0.2)), Eigen::Isometry3d::Identity()), 1e-9);
  EXPECT_LT(distance(model.at(at(0.15)).inverse() * model.at(at(0.05)), T_between), 1e-9)
      << "the same motion seen from the new keyframe";
}

TEST(MotionModel, RemembersNoMoreThanARevolutionNeeds) {
  MotionModel model;
  Vector6d twist;
  twist << 0.0, 0.1, 0.0, 0.5, 0.0, 1.0;
  for (int i = 0; i < 100; ++i) model.observe(at(0.1 * i), exp_se3(twist * 0.1 * i));
  EXPECT_LT(distance(model.at(at(9.33)), exp_se3(twist * 9.33)), 1e-6);
  EXPECT_TRUE(model.at(at(0.0)).matrix().allFinite());
}

}  // namespace
}  // namespace sparsight
