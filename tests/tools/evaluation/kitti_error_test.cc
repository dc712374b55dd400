#include "tools/evaluation/kitti_error.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "tests/tools/evaluation/paths.h"

namespace sparsight {
namespace {

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

KittiError error_between(const Trajectory& estimate, const Trajectory& truth,
                         const SegmentOptions& options = {}) {
  return kitti_error({.truth = truth.poses, .estimate = estimate.poses}, options);
}

TEST(KittiError, IsOnePercentOfAPathStretchedByOnePercent) {
  const KittiError error =
      error_between(testing::straight_path(1001, 1.01), testing::straight_path(1001));
  EXPECT_NEAR(error.t_rel_percent.value(), 1.0, 1e-9);
  EXPECT_NEAR(error.r_rel_deg_per_m.value(), 0.0, 1e-12);
  ASSERT_EQ(error.per_length.size(), 8U);
  for (const SegmentMean& mean : error.per_length) {
    EXPECT_NEAR(mean.t_rel_percent, 1.0, 1e-9) << mean.key;
  }
}

// Steps of one metre with a yaw error of b each: over n steps the heading is off by n b, and the
// end lies at the sum of a geometric series of unit steps in the complex plane.
TEST(KittiError, OfAConstantYawRateBiasIsTheAnalyticOne) {
  const double bias = 1e-4;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  Trajectory estimate;
  for (int i = 0; i < 401; ++i) {
    estimate.poses.push_back(T);
    T = T * testing::pose({0, bias, 0}, {0, 0, testing::kStep_m});
  }
  const KittiError error = error_between(estimate, testing::straight_path(401));
  EXPECT_NEAR(error.r_rel_deg_per_m.value(), bias * kDegPerRad, 1e-9);
  ASSERT_EQ(error.per_length.size(), 4U);
  for (const SegmentMean& mean : error.per_length) {
    const std::complex<double> turn = std::polar(1.0, bias);
    const std::complex<double> end = (std::pow(turn, mean.key) - 1.0) / (turn - 1.0);
    EXPECT_NEAR(mean.t_rel_percent, 100.0 * std::abs(end - mean.key) / mean.key, 1e-9);
  }
}

TEST(KittiError, IsZeroForAPathAgainstItself) {
  const Trajectory path = testing::winding_path(1000);
  const KittiError error = error_between(path, path);
  EXPECT_NEAR(error.t_rel_percent.value(), 0.0, 1e-10);
  EXPECT_NEAR(error.r_rel_deg_per_m.value(), 0.0, 1e-10);
}

TEST(KittiError, EndsASegmentAtTheFirstFrameBeyondItsLength) {
  // Exactly one metre a frame: the frame at 10 m is not beyond 10 m, the one at 11 m is.
  const Trajectory path = testing::path(13, [](double i) {
    return testing::pose({0, 0, 0}, {0, 0, i});
  });
  const KittiError error = error_between(path, path, {.lengths_m = {10.0}, .step_frames = 1});
  ASSERT_EQ(error.segments.size(), 2U);
  EXPECT_EQ(error.segments[0].first, 0U);
  EXPECT_EQ(error.segments[0].last, 11U);
  EXPECT_EQ(error.segments[1].last, 12U);
}

TEST(KittiError, StartsEveryTenFramesAndWeighsLengthsByTheirSegments) {
  // 151 m hold starts 0, 10 .. 50 of 100 m and none of 200 m.
  const KittiError error =
      error_between(testing::straight_path(152, 1.02), testing::straight_path(152));
  EXPECT_EQ(error.segments.size(), 6U);
  ASSERT_EQ(error.per_length.size(), 1U);
  EXPECT_EQ(error.per_length[0].segments, 6U);
}

TEST(KittiError, OfAPathTooShortForAnySegmentIsNothingRatherThanZero) {
  const Trajectory path = testing::straight_path(100);
  const KittiError error = error_between(path, path);
  EXPECT_FALSE(error.t_rel_percent.has_value());
  EXPECT_FALSE(error.r_rel_deg_per_m.has_value());
  EXPECT_TRUE(error.per_length.empty());
  EXPECT_TRUE(error.per_speed.empty());
}

TEST(KittiError, BinsSegmentsByTheSpeedOfTheirTimes) {
  const Trajectory path = testing::straight_path(201);
  PosePairs pairs{.truth = path.poses, .estimate = path.poses};
  // One metre every 0.1 s, as KITTI's camera: 10 m/s, the middle of a bin no other one reaches.
  const KittiError untimed = kitti_error(pairs, {});
  ASSERT_EQ(untimed.per_speed.size(), 1U);
  EXPECT_EQ(untimed.per_speed[0].key, 10.0);
  for (int i = 0; i < 201; ++i) {
    pairs.times.emplace_back(std::chrono::milliseconds(1000 * i));
  }
  EXPECT_NEAR(kitti_error(pairs, {}).segments.at(0).speed_m_per_s, 1.0, 1e-9);
}

TEST(KittiError, ToleratesTimesThatDoNotPass) {
  const Trajectory path = testing::straight_path(201);
  const KittiError error = kitti_error({.truth = path.poses,
                                        .estimate = path.poses,
                                        .times = std::vector<std::chrono::nanoseconds>(201)},
                                       {});
  EXPECT_EQ(error.segments.at(0).speed_m_per_s, 0.0);
}

RC_GTEST_PROP(KittiError, DoesNotDependOnWhereEitherPathStarts, ()) {
  const Trajectory truth = testing::arbitrary_path(40);
  const Trajectory estimate = testing::arbitrary_path(40);
  const SegmentOptions options{.lengths_m = {5, 10, 20}, .step_frames = 3};
  const KittiError still = error_between(estimate, truth, options);
  const KittiError shifted =
      error_between(testing::moved(testing::arbitrary_pose(100.0), estimate),
                    testing::moved(testing::arbitrary_pose(100.0), truth), options);
  RC_ASSERT(still.segments.size() == shifted.segments.size());
  RC_PRE(!still.segments.empty());
  RC_ASSERT(std::abs(*still.t_rel_percent - *shifted.t_rel_percent) < 1e-8);
  RC_ASSERT(std::abs(*still.r_rel_deg_per_m - *shifted.r_rel_deg_per_m) < 1e-8);
}

}  // namespace
}  // namespace sparsight
