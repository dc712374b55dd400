#include "tools/evaluation/evaluation_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/evaluation/paths.h"
#include "tools/session/atomic_file.h"

namespace sparsight {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

// A session folder with both forms of its trajectory, and ground truth in both.
class EvaluationFilesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "session");
    const Trajectory path =
        testing::timed(testing::straight_path(4), std::chrono::milliseconds(100));
    for (const auto& name : {"session/trajectory", "truth"}) {
      write(std::string(name) + ".kitti", format_kitti(path.poses));
      write(std::string(name) + ".tum", format_tum(path));
    }
    write("times.txt", "0\n0.1\n0.2\n0.3\n");
  }
  void write(const std::string& name, const std::string& text) {
    ASSERT_TRUE(write_file(folder_ / name, text));
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) /
      ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(EvaluationFilesTest, TakesTheSessionsTrajectoryInTheFormOfTheGroundTruth) {
  const auto kitti =
      read_trajectories({.estimate = folder_ / "session", .truth = folder_ / "truth.kitti"});
  ASSERT_TRUE(kitti) << kitti.error().message;
  EXPECT_THAT(kitti->estimate.source, EndsWith("trajectory.kitti"));
  const auto tum =
      read_trajectories({.estimate = folder_ / "session", .truth = folder_ / "truth.tum"});
  ASSERT_TRUE(tum) << tum.error().message;
  EXPECT_THAT(tum->estimate.source, EndsWith("trajectory.tum"));
}

TEST_F(EvaluationFilesTest, TakesTheOnlyTrajectoryOfASession) {
  std::filesystem::remove(folder_ / "session/trajectory.kitti");
  EXPECT_THAT(trajectory_in_session(folder_ / "session", TrajectoryFormat::kKitti).value().string(),
              EndsWith("trajectory.tum"));
  EXPECT_THAT(trajectory_in_session(folder_, TrajectoryFormat::kKitti).error().message,
              HasSubstr("without trajectory.kitti or trajectory.tum"));
}

TEST_F(EvaluationFilesTest, GivesTimesToTheOneThatHasNone) {
  const auto pair = read_trajectories({.estimate = folder_ / "truth.kitti",
                                       .truth = folder_ / "truth.tum",
                                       .times = folder_ / "times.txt"});
  ASSERT_TRUE(pair) << pair.error().message;
  EXPECT_EQ(pair->estimate.times, pair->truth.times);
  const auto reverse = read_trajectories({.estimate = folder_ / "truth.tum",
                                          .truth = folder_ / "truth.kitti",
                                          .times = folder_ / "times.txt"});
  ASSERT_TRUE(reverse) << reverse.error().message;
  EXPECT_EQ(reverse->truth.times, reverse->estimate.times);
}

TEST_F(EvaluationFilesTest, TakesTheGroundTruthAsFarAsTheTimesOfACroppedSequenceGo) {
  write("times.txt", "0\n0.1\n");
  const auto pair = read_trajectories({.estimate = folder_ / "truth.tum",
                                       .truth = folder_ / "truth.kitti",
                                       .times = folder_ / "times.txt"});
  ASSERT_TRUE(pair) << pair.error().message;
  EXPECT_EQ(pair->truth.poses.size(), 2U);
}

TEST_F(EvaluationFilesTest, RefusesTimesOfAnotherSequence) {
  write("times.txt", "0\n0.1\n");
  const auto pair = read_trajectories({.estimate = folder_ / "truth.kitti",
                                       .truth = folder_ / "truth.tum",
                                       .times = folder_ / "times.txt"});
  ASSERT_FALSE(pair);
  EXPECT_THAT(pair.error().message, HasSubstr("2 times for the 4 poses"));
}

}  // namespace
}  // namespace sparsight
