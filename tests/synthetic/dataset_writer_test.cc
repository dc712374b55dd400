#include "tests/synthetic/dataset_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

#include "tests/synthetic/synthetic_source.h"

namespace sparsight::synthetic {
namespace {

namespace fs = std::filesystem;

Scene tiny(const char* name) {
  Scene scene = *make_scene(name);
  scene.resize(96, 72);
  if (auto* lidar = std::get_if<SpinningLidar>(&scene.sensor)) lidar->azimuth_step_rad *= 10.0;
  return scene;
}

fs::path fresh_folder(const char* name) {
  const fs::path folder = fs::path(::testing::TempDir()) / "dataset_writer" / name;
  fs::remove_all(folder);
  return folder;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<double> numbers_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<double> numbers;
  for (double number = 0.0; in >> number;) numbers.push_back(number);
  return numbers;
}

TEST(DatasetWriter, OdometryFolderHasWhatKittiHas) {
  const auto folder = write_odometry_folder(tiny("corridor"), 3, fresh_folder("odometry"));
  ASSERT_TRUE(folder) << folder.error().message;
  EXPECT_EQ(folder->filename(), "00");
  EXPECT_TRUE(fs::exists(*folder / "image_0" / "000002.png"));
  EXPECT_EQ(fs::file_size(*folder / "velodyne" / "000002.bin") % 16U, 0U);
  EXPECT_GT(fs::file_size(*folder / "velodyne" / "000002.bin"), 16000U);
  const auto times = lines_of(*folder / "times.txt");
  ASSERT_EQ(times.size(), 3U);
  EXPECT_NEAR(std::stod(times[2]), 0.2, 1e-9);
  EXPECT_THAT(lines_of(*folder / "calib.txt"),
              ::testing::ElementsAre(::testing::StartsWith("P0: "), ::testing::StartsWith("P1: "),
                                     ::testing::StartsWith("P2: "), ::testing::StartsWith("P3: "),
                                     ::testing::StartsWith("Tr: ")));
}

TEST(DatasetWriter, TruthIsTheCamerasPoseInTheFirstOne) {
  const Scene scene = tiny("street");
  const auto folder = write_odometry_folder(scene, 3, fresh_folder("truth"));
  ASSERT_TRUE(folder);
  const auto poses = lines_of(*folder / ".." / ".." / "poses" / "00.txt");
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_NEAR(numbers_of(poses[0])[0], 1.0, 1e-12);
  EXPECT_NEAR(numbers_of(poses[0])[11], 0.0, 1e-12);
  // Two frames of 1.2 m, forward in the camera's axes.
  EXPECT_NEAR(numbers_of(poses[2])[11], 2.4, 0.3);
  const Eigen::Isometry3d T = SyntheticSource(scene, 3).T_first_camera(2);
  EXPECT_NEAR(numbers_of(poses[2])[3], T.translation().x(), 1e-9);
}

TEST(DatasetWriter, RawFolderHasWhatKittiHas) {
  Scene scene = tiny("corridor");
  std::get<SpinningLidar>(scene.sensor).motion_compensated = false;
  const auto drive = write_raw_folder(scene, 2, fresh_folder("raw"));
  ASSERT_TRUE(drive) << drive.error().message;
  for (const char* file :
       {"image_00/data/0000000001.png", "image_00/timestamps.txt",
        "velodyne_points/data/0000000001.bin", "velodyne_points/timestamps_start.txt",
        "velodyne_points/timestamps_end.txt", "poses_camera_0.txt", "../calib_velo_to_cam.txt",
        "../calib_cam_to_cam.txt", "../calib_imu_to_velo.txt"}) {
    EXPECT_TRUE(fs::exists(*drive / file)) << file;
  }
  // A turn of 0.1 s around the exposure one second after noon.
  EXPECT_EQ(lines_of(*drive / "image_00/timestamps.txt")[0], "2011-09-26 12:00:01.000000000");
  EXPECT_EQ(lines_of(*drive / "velodyne_points/timestamps_start.txt")[0],
            "2011-09-26 12:00:00.950000000");
}

TEST(DatasetWriter, AFolderThatCannotBeMadeIsNamed) {
  const auto written = write_odometry_folder(tiny("desk"), 1, "/proc/nowhere");
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, ::testing::HasSubstr("/proc/nowhere"));
}

TEST(SyntheticSource, YieldsItsFramesInOrderAndThenNone) {
  SyntheticSource source(tiny("corridor"), 2);
  EXPECT_EQ(source.frame_count(), 2U);
  const auto first = source.next();
  const auto second = source.next();
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->grey.width, 96);
  EXPECT_FALSE(first->sweep.returns.empty());
  EXPECT_EQ(second->sequence, 1U);
  EXPECT_NEAR(to_seconds(second->exposure - first->exposure), 0.1, 1e-9);
  EXPECT_FALSE(source.next());
}

}  // namespace
}  // namespace sparsight::synthetic
