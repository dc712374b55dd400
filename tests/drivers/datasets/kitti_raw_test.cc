#include "drivers/datasets/kitti_raw.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "drivers/datasets/open_dataset.h"
#include "tests/drivers/datasets/small_dataset.h"

namespace sparsight {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::SmallDrive;

std::vector<SynchronizedFrame> all_frames(const SmallDrive& drive,
                                          const DatasetOptions& options = {}) {
  std::vector<SynchronizedFrame> frames;
  const auto source = open_dataset(drive.folder, options);
  EXPECT_TRUE(source) << source.error().message;
  if (!source) return frames;
  while (auto frame = (*source)->next()) frames.push_back(std::move(*frame));
  return frames;
}

std::string open_error(const SmallDrive& drive, const DatasetOptions& options = {}) {
  const auto source = open_dataset(drive.folder, options);
  return source ? "opened" : source.error().message;
}

// Five frames, all with returns but `missing`.
void expect_only_one_without_depth(const std::vector<SynchronizedFrame>& frames,
                                   std::uint64_t missing) {
  ASSERT_THAT(frames, SizeIs(5));
  for (const SynchronizedFrame& frame : frames) {
    EXPECT_FALSE(frame.grey.empty());
    EXPECT_THAT(frame.faults, SizeIs(frame.sequence == missing ? 1 : 0));
    EXPECT_EQ(frame.sweep.returns.empty(), frame.sequence == missing);
  }
}

TEST(KittiRaw, StampsEveryReturnWithItsFiring) {
  const SmallDrive drive;
  const auto frames = all_frames(drive);
  ASSERT_THAT(frames, SizeIs(5));
  for (const SynchronizedFrame& frame : frames) {
    EXPECT_THAT(frame.faults, IsEmpty());
    EXPECT_FALSE(frame.sweep.motion_compensated);
    EXPECT_THAT(frame.sweep.returns, SizeIs(8 * 90));
    for (const LidarReturn& point : frame.sweep.returns) {
      // The scanner turns clockwise and faces forward at the exposure.
      const double azimuth = std::atan2(point.p_lidar.y(), point.p_lidar.x());
      EXPECT_NEAR(point.from_exposure_ns, -azimuth / CV_PI * 50e6, 100.0);
    }
  }
}

TEST(KittiRaw, TakesTheTriggerForTheExposureNotTheArrival) {
  const SmallDrive drive;
  const auto frames = all_frames(drive);
  ASSERT_THAT(frames, SizeIs(5));
  using namespace std::chrono;
  const nanoseconds start =
      sys_days(year(2011) / 9 / 26).time_since_epoch() + hours(13) + minutes(2) + seconds(25);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(frames[i].exposure.time_since_epoch(), start + milliseconds(100) * i);
  }
}

TEST(KittiRaw, MatchesScansByNumberWhereSomeAreMissing) {
  const SmallDrive drive;
  std::filesystem::remove(drive.scan(2));
  const auto frames = all_frames(drive);
  expect_only_one_without_depth(frames, 2);
  EXPECT_THAT(frames[2].faults[0].message, HasSubstr("0000000002.bin"));
}

TEST(KittiRaw, MatchesScansByNumberWhereTheirTimesAreMissingToo) {
  const SmallDrive drive;
  std::filesystem::remove(drive.scan(2));
  for (const auto& [name, offset] :
       {std::pair("", 0.0), std::pair("_start", -0.05), std::pair("_end", 0.05)}) {
    std::string lines;
    for (const int i : {0, 1, 3, 4}) lines += SmallDrive::time_line(0.1 * i + offset);
    testing::write_file(drive.folder / fmt::format("velodyne_points/timestamps{}.txt", name),
                        lines);
  }
  const auto frames = all_frames(drive);
  expect_only_one_without_depth(frames, 2);
  for (const LidarReturn& point : frames[4].sweep.returns) {
    EXPECT_LT(std::abs(point.from_exposure_ns), 50'100'000);
  }
}

TEST(KittiRaw, LeavesOutAScanWithoutItsTimes) {
  const SmallDrive drive;
  std::string starts;
  for (int i = 0; i < 5; ++i) starts += i == 3 ? "\n" : SmallDrive::time_line(0.1 * i - 0.05);
  testing::write_file(drive.folder / "velodyne_points/timestamps_start.txt", starts);
  const auto frames = all_frames(drive);
  expect_only_one_without_depth(frames, 3);
  EXPECT_THAT(frames[3].faults[0].message, HasSubstr("scan 3"));
}

TEST(KittiRaw, LeavesOutAScanWhoseTurnEndsBeforeItStarts) {
  const SmallDrive drive;
  std::string ends;
  for (int i = 0; i < 5; ++i) ends += SmallDrive::time_line(0.1 * i + (i == 1 ? -0.08 : 0.05));
  testing::write_file(drive.folder / "velodyne_points/timestamps_end.txt", ends);
  expect_only_one_without_depth(all_frames(drive), 1);
}

TEST(KittiRaw, LeavesOutAScanOfAnotherTime) {
  const SmallDrive drive;
  for (const auto& [name, offset] : {std::pair("_start", -0.05), std::pair("_end", 0.05)}) {
    std::string lines;
    for (int i = 0; i < 5; ++i) lines += SmallDrive::time_line(0.1 * i + offset + (i == 4 ? 9 : 0));
    testing::write_file(drive.folder / fmt::format("velodyne_points/timestamps{}.txt", name),
                        lines);
  }
  expect_only_one_without_depth(all_frames(drive), 4);
}

TEST(KittiRaw, ReadsUnrectifiedDrivesWithTheirDistortion) {
  SmallDrive drive("2011_09_26_drive_0042_extract", {44, 16});
  // These drives store scans as text, and their streams are not numbered alike.
  std::filesystem::remove_all(drive.folder / "velodyne_points/data");
  for (int i = 0; i < 5; ++i) {
    std::string text;
    for (const auto& p : testing::cylinder_scan(8)) {
      text += fmt::format("{:.3f} {:.3f} {:.3f} {:.2f}\n", p[0], p[1], p[2], p[3]);
    }
    testing::write_file(drive.folder / fmt::format("velodyne_points/data/{:010}.txt", i + 1), text);
  }
  for (const auto& [name, offset] :
       {std::pair("", 0.0), std::pair("_start", -0.05), std::pair("_end", 0.05)}) {
    std::string lines = SmallDrive::time_line(-0.1 + offset);
    for (int i = 0; i < 5; ++i) lines += SmallDrive::time_line(0.1 * i + offset);
    testing::write_file(drive.folder / fmt::format("velodyne_points/timestamps{}.txt", name),
                        lines);
  }
  const auto source = open_dataset(drive.folder, {});
  ASSERT_TRUE(source) << source.error().message;
  const CameraIntrinsics& camera = (*source)->calibration().camera;
  EXPECT_EQ(camera.width, 44);
  EXPECT_EQ(camera.fx, 55);
  EXPECT_EQ(camera.cy, 8);
  EXPECT_EQ(camera.k1, -0.37);
  EXPECT_EQ(camera.p1, 0.002);
  EXPECT_EQ(camera.k3, -0.07);
  const auto frames = all_frames(drive);
  ASSERT_THAT(frames, SizeIs(5));
  for (const SynchronizedFrame& frame : frames) {
    EXPECT_THAT(frame.faults, IsEmpty());
    ASSERT_THAT(frame.sweep.returns, SizeIs(8 * 90));
    EXPECT_LT(std::abs(frame.sweep.returns.front().from_exposure_ns), 2'000'000);
  }
}

TEST(KittiRaw, NamesTheMissingCalibration) {
  const SmallDrive drive;
  std::filesystem::remove(drive.day / "calib_velo_to_cam.txt");
  EXPECT_THAT(open_error(drive), AllOf(HasSubstr("calib_velo_to_cam.txt"), HasSubstr("calib.zip")));
}

TEST(KittiRaw, NamesTheMissingCalibrationField) {
  const SmallDrive drive;
  testing::write_file(drive.day / "calib_velo_to_cam.txt", "R: 0 -1 0 0 0 -1 1 0 0\n");
  EXPECT_THAT(open_error(drive), AllOf(HasSubstr("calib_velo_to_cam.txt"), HasSubstr("field T ")));
}

TEST(KittiRaw, RefusesAMatrixThatIsNoRotation) {
  const SmallDrive drive;
  testing::write_file(drive.day / "calib_velo_to_cam.txt", "R: 0 -1 0 0 0 -1 1 0 1\nT: 0 0 0\n");
  EXPECT_THAT(open_error(drive),
              AllOf(HasSubstr("calib_velo_to_cam.txt:1"), HasSubstr("rotation")));
}

TEST(KittiRaw, RefusesImageTimesThatGoBackwards) {
  const SmallDrive drive;
  std::string lines;
  for (const double t : {0.0, 0.1, 0.3, 0.2, 0.4}) lines += SmallDrive::time_line(t);
  testing::write_file(drive.folder / "image_00/timestamps.txt", lines);
  EXPECT_THAT(open_error(drive), AllOf(HasSubstr("image_00"), HasSubstr("timestamps.txt:4")));
}

TEST(KittiRaw, RefusesFewerImageTimesThanImages) {
  const SmallDrive drive;
  testing::write_file(drive.folder / "image_00/timestamps.txt", SmallDrive::time_line(0));
  EXPECT_THAT(open_error(drive), AllOf(HasSubstr("timestamps.txt"), HasSubstr("1 lines")));
}

TEST(KittiRaw, RefusesADriveWithoutSweepTimes) {
  const SmallDrive drive;
  std::filesystem::remove(drive.folder / "velodyne_points/timestamps_start.txt");
  EXPECT_THAT(open_error(drive),
              AllOf(HasSubstr("timestamps_start.txt"), HasSubstr("no such file")));
}

}  // namespace
}  // namespace sparsight
