#include "slam/lidar/sweep_arbiter.h"

#include <gtest/gtest.h>

#include "tests/slam/lidar/scanned_room.h"
#include "tests/slam/room_rig.h"

namespace sparsight {
namespace {

// Camera axes; the rig has moved ahead and turned.
const Eigen::Isometry3d kThere = pose(0.0, 0.03, 0.0, 0.05, 0.0, 0.2);

SweepArbiter::Opinion opinion_in(const ScannedRoom& room) {
  const Eigen::Isometry3d T_camera_lidar = RoomRig::mount();
  const SweepSurface surface = room.surface(kHere);
  const Eigen::Isometry3d T_room_lidar = T_camera_lidar.inverse() * kThere * T_camera_lidar;
  SweepArbiter arbiter(T_camera_lidar);
  arbiter.hear(room.sweep(T_room_lidar, 2), Vector6d::Zero(), surface, kHere);
  const SweepArbiter::Opinion opinion = arbiter.opinion(kHere);
  EXPECT_GT(arbiter.share(opinion.T_keyframe_camera), arbiter.share(kHere));
  return opinion;
}

TEST(SweepArbiter, IsSureOfWhereItIsInARoom) {
  const SweepArbiter::Opinion opinion = opinion_in({});
  EXPECT_TRUE(opinion.sure);
  EXPECT_GT(opinion.share, 0.9);
  EXPECT_LT(shift_between(opinion.T_keyframe_camera, kThere), 0.03);
  EXPECT_LT(turn_between(opinion.T_keyframe_camera, kThere), 0.005);
}

TEST(SweepArbiter, IsNotInACorridor) { EXPECT_FALSE(opinion_in(endless_corridor()).sure); }

TEST(SweepArbiter, IsNotWithoutASweep) {
  const SweepSurface surface = ScannedRoom().surface(kHere);
  SweepArbiter arbiter(RoomRig::mount());
  arbiter.hear({}, Vector6d::Zero(), surface, kHere);
  EXPECT_EQ(arbiter.share(kHere), 0.0);
  EXPECT_FALSE(arbiter.opinion(kHere).sure);
}

}  // namespace
}  // namespace sparsight
