#include "tools/evaluation/loop_error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/evaluation/made_session.h"

namespace sparsight {
namespace {

using testing::kFramesRound;
using testing::kKeyframeEvery;
using testing::loop_of;

class LoopErrorTest : public ::testing::Test {
 protected:
  LoopError judged() const { return loop_error(session_, truth_, {}).value(); }

  const Trajectory truth_ = testing::round_way(1.5);
  SessionLoops session_ = testing::session_on(truth_);
};

TEST_F(LoopErrorTest, ALoopThatIsOffByMoreThanMeasuringCanBeIsFalse) {
  session_.loops = {loop_of(truth_, kFramesRound, 0, 0.02),
                    loop_of(truth_, kFramesRound + 5, 0, -3.0)};
  const LoopError error = judged();
  EXPECT_EQ(error.loops, 2);
  EXPECT_EQ(error.false_loops, 1);
  EXPECT_NEAR(error.max_error_m, 3.0, 1e-9);
}

TEST_F(LoopErrorTest, ALoopThatIsTurnedIsFalse) {
  SessionLoops::Loop loop = loop_of(truth_, kFramesRound, 0);
  loop.T_frame_before.rotate(Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitX()));
  session_.loops = {loop};
  EXPECT_EQ(judged().false_loops, 1);
  EXPECT_NEAR(judged().max_error_deg, 0.03 * 180.0 / M_PI, 1e-6);
}

TEST_F(LoopErrorTest, TellsWhichPlacesPassedAgainWereNotRecognised) {
  const std::size_t second_lap = kFramesRound / 2 / kKeyframeEvery;
  // Whatever is within a metre of a place of the first lap: the last of that, too.
  const LoopError without = judged();
  EXPECT_EQ(without.keyframes, 3 * second_lap);
  EXPECT_GE(without.revisits, second_lap);
  EXPECT_LE(without.revisits, second_lap + 1);
  EXPECT_EQ(without.closed, 0);
  session_.loops = {loop_of(truth_, kFramesRound, 0), loop_of(truth_, kFramesRound + 10, 5),
                    loop_of(truth_, kFramesRound + 20, 15, 9.0)};
  EXPECT_EQ(judged().closed, 2) << "a false one does not count";
}

TEST_F(LoopErrorTest, KeyframesJustBeforePassNoPlaceAgainUnlessASubmapBeganBetween) {
  SessionLoops standing = session_;
  for (auto& [frame, exposure] : standing.exposures) exposure = truth_.times.front();
  Trajectory still = truth_;
  for (Eigen::Isometry3d& pose : still.poses) pose = truth_.poses.front();
  standing.keyframes.resize(30);
  for (std::size_t i = 0; i < still.times.size(); ++i) standing.exposures[i] = still.times[i];
  EXPECT_EQ(loop_error(standing, still, {}).value().revisits, 0);
  standing.submaps.push_back({.first_frame = 10 * kKeyframeEvery, .part = 10 * kKeyframeEvery});
  EXPECT_EQ(loop_error(standing, still, {}).value().revisits, 20);
}

TEST_F(LoopErrorTest, ASubmapThatAFalseLoopJoinedIsJoinedFalsely) {
  session_.submaps = {{.first_frame = 0, .part = 0},
                      {.first_frame = kFramesRound, .part = 0},
                      {.first_frame = kFramesRound + 50, .part = 0},
                      {.first_frame = kFramesRound + 100, .part = kFramesRound + 100}};
  session_.loops = {loop_of(truth_, kFramesRound + 5, 5),
                    loop_of(truth_, kFramesRound + 60, 60, 3.2)};
  const LoopError error = judged();
  EXPECT_EQ(error.submaps, 4);
  EXPECT_EQ(error.joined, 2);
  EXPECT_EQ(error.joined_falsely, 1);
}

TEST_F(LoopErrorTest, GroundTruthWithoutTimesIsOfTheFramesInTheirOrder) {
  Trajectory timeless = truth_;
  timeless.times.clear();
  session_.loops = {loop_of(truth_, kFramesRound, 0, 0.02)};
  EXPECT_NEAR(loop_error(session_, timeless, {}).value().max_error_m, 0.02, 1e-9);
}

TEST_F(LoopErrorTest, ALoopOfWhichNoTruthIsKnownIsNotPassedOver) {
  session_.loops = {loop_of(truth_, kFramesRound, 0)};
  Trajectory shorter = truth_;
  shorter.poses.resize(100);
  shorter.times.resize(100);
  EXPECT_THAT(loop_error(session_, shorter, {}).error().message,
              ::testing::HasSubstr("has no pose of frame 0 or of frame 300"));
}

}  // namespace
}  // namespace sparsight
