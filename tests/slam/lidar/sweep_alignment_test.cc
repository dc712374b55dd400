#include "slam/lidar/sweep_alignment.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>

#include "slam/lidar/sweep_sample.h"
#include "tests/slam/lidar/scanned_room.h"
#include "tests/slam/random_values.h"

namespace sparsight {
namespace {

std::vector<Eigen::Vector3f> sample(const SweepSurface& surface, const Sweep& sweep,
                                    const Eigen::Isometry3d& start) {
  std::vector<Eigen::Vector3f> result;
  sample_sweep(sweep, Vector6d::Zero(), surface, start, result);
  return result;
}

SweepFit aligned(const SweepSurface& surface, const Sweep& sweep, const Eigen::Isometry3d& start) {
  return align_sweep(surface, sample(surface, sweep, start), start);
}

RC_GTEST_PROP(AlignSweep, FindsWhereTheScannerIs, ()) {
  ScannedRoom room;
  room.rings = *rc::gen::element(16, 64);
  room.ring_deg = room.rings == 64 ? 0.4 : 2.0;
  const Eigen::Isometry3d T_true = exp_se3(any_increment(0.05, 0.25));
  const SweepFit fit = aligned(room.surface(kHere), room.sweep(T_true, 2), kHere);
  RC_ASSERT(shift_between(fit.T_keyframe_lidar, T_true) < 0.04);
  RC_ASSERT(turn_between(fit.T_keyframe_lidar, T_true) < 0.01);
  RC_ASSERT(fit.share > 0.8);
}

TEST(AlignSweep, KnowsHowMuchOfTheSweepLiesOnTheSurface) {
  const ScannedRoom room;
  const SweepSurface surface = room.surface(kHere);
  const auto returns = sample(surface, room.sweep(kHere, 2), kHere);
  const double here = fit_of_sweep(surface, returns, kHere).share;
  const double beside = fit_of_sweep(surface, returns, pose(0, 0, 0, 0.3, 0.2, 0)).share;
  const double turned = fit_of_sweep(surface, returns, pose(0, 0, 0.1, 0, 0, 0)).share;
  EXPECT_GT(here, 0.9);
  EXPECT_LT(beside, 0.7);
  EXPECT_LT(turned, 0.7);
}

// Alongside, 1.2 m away: it takes a third of the returns, and half a metre of its way in a frame.
TEST(AlignSweep, StaysWithTheHouseWhenABusLeaves) {
  const ScannedRoom yard{.lowest = {-25.0, -18.0, -1.6}, .highest = {30.0, 20.0, 12.0}};
  for (const double gone : {0.1, 0.2, 0.5}) {
    const Obstacle bus{{-3.0, 1.2, -1.3}, {8.0, 3.8, 1.8}};
    Obstacle leaving = bus;
    leaving.lowest.x() += gone;
    leaving.highest.x() += gone;
    const SweepSurface surface = yard.surface(kHere, bus);
    const SweepFit fit = aligned(surface, yard.sweep(kHere, 2, leaving), kHere);
    EXPECT_LT(fit.T_keyframe_lidar.translation().norm(), 0.03) << gone;
  }
}

TEST(AlignSweep, KnowsThatACorridorDoesNotTellHowFarItWasGone) {
  const ScannedRoom corridor = endless_corridor();
  const SweepFit fit = aligned(corridor.surface(kHere), corridor.sweep(kHere, 2), kHere);
  EXPECT_GT(fit.share, 0.8);
  EXPECT_LT(fit.facing(0, 0), 0.05 * fit.facing(1, 1));
}

TEST(AlignSweep, SaysNothingOfNothing) {
  const SweepSurface surface = ScannedRoom().surface(kHere);
  EXPECT_EQ(align_sweep(surface, {}, kHere).share, 0.0);
  EXPECT_TRUE(align_sweep(surface, {}, kHere).information.isZero());
  const auto returns = sample(surface, ScannedRoom().sweep(kHere, 2), kHere);
  EXPECT_EQ(align_sweep({}, returns, kHere).share, 0.0);
  Eigen::Isometry3d nowhere = kHere;
  nowhere.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fit_of_sweep(surface, returns, nowhere).share, 0.0);
  EXPECT_EQ(align_sweep(surface, returns, nowhere).share, 0.0);
  EXPECT_EQ(fit_of_sweep(surface, returns, pose(0, 0, 0, 500, 0, 0)).returns, 0U);
}

}  // namespace
}  // namespace sparsight
