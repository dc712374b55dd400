#include "tools/evaluation/part_error.h"

#include <gtest/gtest.h>

#include "tests/tools/evaluation/made_session.h"

namespace sparsight {
namespace {

// Tracking was lost after half a lap: what comes then stands anywhere.
class PartError : public ::testing::Test {
 protected:
  static constexpr std::size_t kLost = testing::kFramesRound / 2;
  PartError() {
    session_.submaps.push_back({.first_frame = kLost, .part = kLost});
    for (std::size_t i = kLost; i < estimate_.poses.size(); ++i) {
      estimate_.poses[i] = elsewhere_ * estimate_.poses[i];
    }
  }

  const Trajectory truth_ = testing::round_way(1.0);
  const Eigen::Isometry3d elsewhere_ = testing::pose({0.1, 1.0, 0.0}, {5.0, 0.0, -3.0});
  SessionLoops session_ = testing::session_on(truth_);
  Trajectory estimate_ = truth_;
};

TEST_F(PartError, OfPartsThatStandAnywhereIsThatOfEachForItself) {
  EXPECT_NEAR(part_error_m(estimate_, truth_, submaps_of_time(session_)).value(), 0.0, 1e-9);
  EXPECT_NEAR(part_error_m(estimate_, truth_, joined_parts_of_time(session_)).value(), 0.0, 1e-9);
}

TEST_F(PartError, OfWhatLoopsHaveJoinedWronglyIsLarge) {
  session_.submaps[1].part = 0;
  EXPECT_NEAR(part_error_m(estimate_, truth_, submaps_of_time(session_)).value(), 0.0, 1e-9);
  EXPECT_GT(part_error_m(estimate_, truth_, joined_parts_of_time(session_)).value(), 1.0);
}

TEST_F(PartError, WithoutACommonTimeThereIsNone) {
  const Trajectory another_day =
      testing::timed(testing::straight_path(4), testing::kPeriod, std::chrono::hours(24));
  EXPECT_FALSE(part_error_m(another_day, truth_, submaps_of_time(session_)));
  EXPECT_FALSE(part_error_m(estimate_, truth_, {}));
}

}  // namespace
}  // namespace sparsight
