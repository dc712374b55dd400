#include "tools/evaluation/revisit_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace sparsight {
namespace {

constexpr int kFramesPerLap = 400;
constexpr double kRadiusM = 10.0;

// Round a circle of 63 m, looking along it. The estimate drifts sideways by `drift_m` a lap.
PosePairs laps(double count, double drift_m) {
  PosePairs pairs;
  for (int i = 0; i <= static_cast<int>(count * kFramesPerLap); ++i) {
    const double share = static_cast<double>(i) / kFramesPerLap;
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.rotate(Eigen::AngleAxisd(2.0 * std::numbers::pi * share, Eigen::Vector3d::UnitY()));
    T.translate(Eigen::Vector3d(0, 0, kRadiusM));
    pairs.truth.push_back(T);
    pairs.estimate.push_back(Eigen::Translation3d(0, drift_m * share, 0) * T);
  }
  return pairs;
}

TEST(RevisitError, IsHowFarLaterPassesComeApartFromTheFirst) {
  const RevisitError error = revisit_error(laps(3.0, 0.05), {.places = 4});
  EXPECT_EQ(error.places, 4);
  ASSERT_EQ(error.revisits.size(), 4 * 2 + 1);  // the start is passed four times
  for (const Revisit& revisit : error.revisits) {
    const double laps_between = std::round(revisit.way_m / (2.0 * std::numbers::pi * kRadiusM));
    EXPECT_NEAR(revisit.error_m, 0.05 * laps_between, 1e-3) << revisit.place;
    EXPECT_NEAR(revisit.error_deg, 0.0, 1e-6);
  }
  EXPECT_NEAR(error.max_m, 0.15, 1e-3);
  // Start: 1, 2, 3 laps; three others: 1, 2 laps.
  EXPECT_NEAR(error.rmse_m, 0.05 * std::sqrt((1 + 4 + 9 + 3 * (1 + 4)) / 9.0), 1e-3);
}

TEST(RevisitError, PlacesStandAtEqualDistancesAlongTheFirstLap) {
  const RevisitError error = revisit_error(laps(2.0, 0.0), {.places = 4});
  ASSERT_GE(error.revisits.size(), 4);
  for (const Revisit& revisit : error.revisits) {
    EXPECT_NEAR(static_cast<double>(revisit.first),
                static_cast<double>(revisit.place) * kFramesPerLap / 4.0,
                12.0);  // a lap ends 2 m early
  }
  EXPECT_NEAR(error.max_m, 0.0, 1e-9);
}

TEST(RevisitError, AWayThatDoesNotComeBackHasNone) {
  EXPECT_TRUE(revisit_error(laps(0.9, 0.05), {.places = 4}).revisits.empty());
  EXPECT_EQ(revisit_error(laps(0.9, 0.05), {.places = 4}).places, 0);
  EXPECT_TRUE(revisit_error({}, {.places = 4}).revisits.empty());
  EXPECT_TRUE(revisit_error(laps(3.0, 0.05), {}).revisits.empty());
}

TEST(RevisitError, StandingAtAPlaceIsOnePass) {
  PosePairs pairs = laps(1.5, 0.0);
  for (int i = 0; i < 50; ++i) {
    pairs.truth.push_back(pairs.truth.back());
    pairs.estimate.push_back(pairs.estimate.back());
  }
  for (const Revisit& revisit : revisit_error(pairs, {.places = 8}).revisits) {
    EXPECT_GT(revisit.way_m, 50.0);
  }
}

}  // namespace
}  // namespace sparsight
