#include "tools/evaluation/trajectory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/tools/evaluation/paths.h"

namespace sparsight {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr auto kKittiLine = "1 0 0 2.5 0 1 0 -3 0 0 1 4e1\n";
constexpr auto kTumLine = "1305031102.175304000 1 2 3 0 0 0 1\n";

std::string error_of(std::string_view text, std::optional<TrajectoryFormat> format = {}) {
  const auto trajectory = parse_trajectory(text, "drive.txt", format);
  return trajectory ? "" : trajectory.error().message;
}

TEST(Trajectory, ReadsKittiRowsAsCameraToWorld) {
  // A quarter turn about y: the camera's z axis points along the world's x.
  const auto trajectory = parse_trajectory("0 0 1 7 0 1 0 8 -1 0 0 9\n", "a");
  ASSERT_TRUE(trajectory) << trajectory.error().message;
  const Eigen::Vector3d p_world = trajectory->poses.at(0) * Eigen::Vector3d(0, 0, 1);
  EXPECT_EQ(p_world, Eigen::Vector3d(8, 8, 9));
  EXPECT_TRUE(trajectory->times.empty());
}

TEST(Trajectory, ReadsTumQuaternionsWithTheScalarLast) {
  const auto trajectory = parse_trajectory(
      "# a comment\n1305031102.175304000 7 8 9 0 0.70710678118654757 0 0.70710678118654757\n", "a");
  ASSERT_TRUE(trajectory) << trajectory.error().message;
  const Eigen::Vector3d p_world = trajectory->poses.at(0) * Eigen::Vector3d(0, 0, 1);
  EXPECT_TRUE(p_world.isApprox(Eigen::Vector3d(8, 8, 9), 1e-15));
  EXPECT_EQ(trajectory->times.at(0).time_since_epoch().count(), 1'305'031'102'175'304'000);
}

TEST(Trajectory, KeepsEveryNanosecondOfTodaysDates) {
  const auto trajectory = parse_trajectory("1763792701.123456789 0 0 0 0 0 0 1", "a");
  ASSERT_TRUE(trajectory);
  EXPECT_EQ(trajectory->times.at(0).time_since_epoch().count(), 1'763'792'701'123'456'789);
}

TEST(Trajectory, ReadsTimesHoweverTheyAreWritten) {
  const std::pair<const char*, std::int64_t> cases[] = {
      {"1763792701", 1'763'792'701'000'000'000},
      {"0.1", 100'000'000},
      {".5", 500'000'000},
      {"5.", 5'000'000'000},
      {"+2.25", 2'250'000'000},
      {"-1.5", -1'500'000'000},
      {"0.0000000014", 1},
      {"0.9999999995", 1'000'000'000},
      {"1.037533e-01", 103'753'300},
      {"4.5e3", 4'500'000'000'000},
  };
  for (const auto& [text, expected] : cases) {
    const auto times = parse_times(text, "times.txt");
    ASSERT_TRUE(times) << times.error().message;
    EXPECT_EQ(times->at(0).time_since_epoch().count(), expected) << text;
  }
}

TEST(Trajectory, ReadsExponentsPlusSignsTabsWindowsLineEndsAndAByteOrderMark) {
  const auto trajectory =
      parse_trajectory("\xEF\xBB\xBF+1e0\t0 0 2.5e+00 0 1 0 0 0 0 1 0\r\n\r\n", "a");
  ASSERT_TRUE(trajectory) << trajectory.error().message;
  EXPECT_EQ(trajectory->poses.at(0).translation().x(), 2.5);
}

TEST(Trajectory, AcceptsRotationsRoundedToSevenDigits) {
  EXPECT_EQ(error_of("9.999978e-01 5.272628e-04 -2.066935e-03 -4.690294e-02 -5.296506e-04 "
                     "9.999992e-01 -1.154865e-03 -2.839928e-02 2.066324e-03 1.155958e-03 "
                     "9.999971e-01 8.586941e-01\n"),
            "");
}

TEST(Trajectory, NamesFileLineAndFieldOfWhatIsNotANumber) {
  const std::string text = std::string(kKittiLine) + "1 0 0 nan 0 1 0 0 0 0 1 0\n";
  EXPECT_THAT(error_of(text), AllOf(StartsWith("drive.txt:2: field 4 ('nan')")));
  EXPECT_THAT(error_of("1 0 0 1,5 0 1 0 0 0 0 1 0\n"), HasSubstr("field 4 ('1,5')"));
  EXPECT_THAT(error_of("1 0 0 1e999 0 1 0 0 0 0 1 0\n"), HasSubstr("field 4 ('1e999')"));
}

TEST(Trajectory, CountsCommentsAndEmptyLinesInLineNumbers) {
  EXPECT_THAT(error_of("# head\n\n1 2 3 4 5\n"), StartsWith("drive.txt:3: 5 fields"));
}

TEST(Trajectory, SaysThatALineIsCutOff) {
  EXPECT_THAT(
      error_of(std::string(kKittiLine) + "1 0 0 2.5 0 1"),
      AllOf(StartsWith("drive.txt:2: 6 fields, but a KITTI pose has 12"), HasSubstr("cut off")));
}

TEST(Trajectory, HoldsAFileToTheFormatItWasToldToBe) {
  EXPECT_THAT(error_of(kKittiLine, TrajectoryFormat::kTum), HasSubstr("a TUM pose has 8"));
  EXPECT_THAT(error_of(kTumLine, TrajectoryFormat::kKitti), HasSubstr("a KITTI pose has 12"));
}

TEST(Trajectory, RefusesMatricesThatAreNoRotations) {
  EXPECT_THAT(error_of("2 0 0 0 0 1 0 0 0 0 1 0\n"), HasSubstr("not a rotation matrix"));
  EXPECT_THAT(error_of("1 0 0 0 0 1 0 0 0 0 -1 0\n"), HasSubstr("not a rotation matrix"));
}

TEST(Trajectory, RefusesQuaternionsThatAreNotUnit) {
  EXPECT_THAT(error_of("0 1 2 3 0 0 0 0\n"), HasSubstr("fields 5-8 (qx qy qz qw) have length 0"));
}

TEST(Trajectory, RefusesTimesThatGoBackwards) {
  EXPECT_THAT(
      error_of("2 0 0 0 0 0 0 1\n1.5 0 0 0 0 0 0 1\n"),
      AllOf(StartsWith("drive.txt:2: field 1, the time 1.5, is before"), HasSubstr("sort")));
}

TEST(Trajectory, RefusesTimesInNanosecondsAndPositionsOutOfThisWorld) {
  EXPECT_THAT(error_of("1763792701123456789 0 0 0 0 0 0 1\n"), HasSubstr("must be in seconds"));
  EXPECT_THAT(error_of("1 0 0 1e300 0 1 0 0 0 0 1 0\n"), HasSubstr("positions are in metres"));
}

TEST(Trajectory, RefusesAFileWithoutPoses) {
  EXPECT_EQ(error_of("# nothing\n"), "drive.txt: holds no pose");
  EXPECT_EQ(error_of(""), "drive.txt: holds no pose");
}

TEST(Trajectory, GivesKittiPosesTheTimesOfTheirFrames) {
  const auto times = parse_times("0.000000e+00\n1.037533e-01\n2.0e-1\n", "times.txt");
  ASSERT_TRUE(times) << times.error().message;
  const auto two = with_times(testing::straight_path(2), *times, "times.txt");
  ASSERT_TRUE(two);
  EXPECT_EQ(two->times.size(), 2U);
  EXPECT_EQ(two->times.at(1).time_since_epoch().count(), 103'753'300);

  const auto four = with_times(testing::straight_path(4), *times, "times.txt");
  ASSERT_FALSE(four);
  EXPECT_THAT(four.error().message, HasSubstr("has 3 times for the 4 poses"));
}

TEST(Trajectory, RefusesATimesFileOfAnotherShape) {
  EXPECT_THAT(parse_times("0.1\n0.2 0.3\n", "times.txt").error().message,
              StartsWith("times.txt:2: 2 fields"));
  EXPECT_THAT(parse_times("0.2\n0.1\n", "times.txt").error().message, StartsWith("times.txt:2:"));
}

RC_GTEST_PROP(Trajectory, KittiTextReadsBackToTheSameBits, ()) {
  const Trajectory written = testing::arbitrary_path(5);
  const auto read = parse_trajectory(format_kitti(written.poses), "a");
  RC_ASSERT(read.has_value());
  for (std::size_t i = 0; i < written.poses.size(); ++i) {
    RC_ASSERT(read->poses.at(i).matrix() == written.poses[i].matrix());
  }
}

RC_GTEST_PROP(Trajectory, TumTextReadsBackToTheSameTimesPositionsAndRotations, ()) {
  const std::chrono::nanoseconds start(
      *rc::gen::inRange<std::int64_t>(-4'000'000'000'000'000'000, 4'000'000'000'000'000'000));
  const Trajectory written =
      testing::timed(testing::arbitrary_path(5), std::chrono::nanoseconds(33'333'333), start);
  const auto read = parse_trajectory(format_tum(written), "a");
  RC_ASSERT(read.has_value());
  RC_ASSERT(read->times == written.times);
  for (std::size_t i = 0; i < written.poses.size(); ++i) {
    RC_ASSERT(read->poses.at(i).translation() == written.poses[i].translation());
    RC_ASSERT(read->poses.at(i).linear().isApprox(written.poses[i].linear(), 1e-14));
  }
}

RC_GTEST_PROP(Trajectory, AnyTextIsReadOrRefusedWithItsName, (const std::string& text)) {
  const auto trajectory = parse_trajectory(text, "hostile.txt");
  RC_ASSERT(trajectory.has_value() || trajectory.error().message.starts_with("hostile.txt:"));
}

}  // namespace
}  // namespace sparsight
