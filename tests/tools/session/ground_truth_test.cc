#include "tools/session/ground_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "tests/tools/session/sample_session.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;

fs::path data_set() {
  const fs::path root = fs::path(::testing::TempDir()) / "ground_truth_layouts";
  fs::create_directories(root / "sequences/04");
  fs::create_directories(root / "poses");
  fs::create_directories(root / "2011_09_26/drive_0005_sync");
  std::ofstream(root / "poses/04.txt") << "1 0 0 0 0 1 0 0 0 0 1 0\n";
  std::ofstream(root / "2011_09_26/drive_0005_sync/poses_camera_0.txt") << "\n";
  return root;
}

TEST(GroundTruth, IsFoundWhereTheLayoutsHaveItForCameraZeroOnly) {
  const fs::path root = data_set();
  EXPECT_TRUE(
      fs::equivalent(find_ground_truth(root / "sequences/04/", 0).value(), root / "poses/04.txt"));
  EXPECT_TRUE(fs::equivalent(find_ground_truth(root / "2011_09_26/drive_0005_sync", 0).value(),
                             root / "2011_09_26/drive_0005_sync/poses_camera_0.txt"));
  EXPECT_FALSE(find_ground_truth(root / "sequences/04", 2));
  EXPECT_FALSE(find_ground_truth(root / "2011_09_26", 0));
  EXPECT_FALSE(find_ground_truth(root / "nowhere", 0));
}

TEST(GroundTruth, OtherCameraIsToldWhyItIsNotCompared) {
  Session session = sample_session(20);
  session.description.source = data_set() / "sequences/04";
  session.description.camera = 2;
  add_ground_truth(session, {});
  EXPECT_FALSE(session.truth);
  EXPECT_THAT(session.notes, ::testing::ElementsAre(::testing::HasSubstr("camera 0")));
}

TEST(GroundTruth, LongPathsAreMeasuredOverLongSegmentsShortOnesOverShort) {
  const fs::path file = fs::path(::testing::TempDir()) / "segments_truth.txt";
  EXPECT_EQ(sample_session(600, file).truth->evaluation.kitti.per_length.front().key, 100.0);
  EXPECT_EQ(sample_session(100, file).truth->evaluation.kitti.per_length.front().key, 10.0);
}

TEST(GroundTruth, IsMovedToWhereTheSessionBegins) {
  const Session session = sample_session(50);
  const Eigen::Isometry3d T_truth_world(Eigen::Translation3d(5, 6, 7) *
                                        Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 2) / 3));
  std::vector<Eigen::Isometry3d> truth;
  for (const TrajectoryPose& pose : session.trajectory) {
    truth.push_back(T_truth_world * pose.T_world_camera);
  }
  const fs::path file = fs::path(::testing::TempDir()) / "moved_truth.txt";
  ASSERT_TRUE(write_file(file, format_kitti(truth)));
  const GroundTruth compared = compare_with_ground_truth(session.trajectory, file).value();
  ASSERT_EQ(compared.positions.size(), 50U);
  EXPECT_TRUE(compared.positions.back().isApprox(
      session.trajectory.back().T_world_camera.translation(), 1e-9));
  EXPECT_LT(compared.evaluation.ate.rmse_m, 1e-9);
}

TEST(GroundTruth, WithTimesIsPairedByTime) {
  const Session session = sample_session(50);
  Trajectory truth;
  for (std::size_t i = 10; i < 40; ++i) {
    truth.poses.push_back(session.trajectory[i].T_world_camera);
    truth.times.push_back(session.trajectory[i].exposure);
  }
  const fs::path file = fs::path(::testing::TempDir()) / "timed_truth.tum";
  ASSERT_TRUE(write_file(file, format_tum(truth)));
  const GroundTruth compared = compare_with_ground_truth(session.trajectory, file).value();
  EXPECT_EQ(compared.positions.size(), 30U);
  EXPECT_LT(compared.evaluation.ate.rmse_m, 1e-6);
}

TEST(GroundTruth, UnreadableFileIsNotedNotFatal) {
  Session session = sample_session(20);
  add_ground_truth(session, fs::path("/nonexistent/poses.txt"));
  EXPECT_FALSE(session.truth);
  EXPECT_THAT(session.notes,
              ::testing::ElementsAre(::testing::HasSubstr("/nonexistent/poses.txt")));
}

}  // namespace
}  // namespace sparsight
