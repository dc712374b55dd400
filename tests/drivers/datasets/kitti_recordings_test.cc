#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "drivers/datasets/open_dataset.h"
#include "tests/build_paths.h"

// What is known of the real recordings, by their authors' description or by counting.
namespace sparsight {
namespace {

std::filesystem::path sequence_04() {
  return testing::recordings() / "kitti/odometry/sequences/04";
}
std::filesystem::path drive_0005() {
  return testing::recordings() / "kitti/raw/2011_09_26/2011_09_26_drive_0005_sync";
}

std::vector<SynchronizedFrame> all_frames(const std::filesystem::path& folder,
                                          const DatasetOptions& options = {}) {
  std::vector<SynchronizedFrame> frames;
  const auto source = open_dataset(folder, options);
  EXPECT_TRUE(source) << source.error().message;
  if (!source) return frames;
  while (auto frame = (*source)->next()) frames.push_back(std::move(*frame));
  return frames;
}

std::set<int> rings_in(const Sweep& sweep) {
  std::set<int> rings;
  for (const LidarReturn& point : sweep.returns) rings.insert(point.ring);
  return rings;
}

double median_elevation(const Sweep& sweep, int ring) {
  std::vector<double> elevations;
  for (const LidarReturn& point : sweep.returns) {
    if (point.ring != ring) continue;
    elevations.push_back(std::atan2(point.p_lidar.z(), point.p_lidar.head<2>().norm()));
  }
  std::nth_element(elevations.begin(), elevations.begin() + elevations.size() / 2,
                   elevations.end());
  return elevations[elevations.size() / 2];
}

TEST(KittiRecordings, SequenceHas51FramesOf64Rings) {
  if (!std::filesystem::exists(sequence_04())) GTEST_SKIP() << "no recordings";
  const auto frames = all_frames(sequence_04());
  ASSERT_EQ(frames.size(), 51U);
  for (const SynchronizedFrame& frame : frames) {
    EXPECT_TRUE(frame.faults.empty());
    EXPECT_TRUE(frame.sweep.motion_compensated);
    EXPECT_EQ(rings_in(frame.sweep).size(), 64U) << frame.sequence;
    EXPECT_EQ(frame.grey.pixels.size(), 1226U * 370U);
  }
  EXPECT_EQ(frames[1].exposure.time_since_epoch(), std::chrono::nanoseconds(104'128'400));
}

TEST(KittiRecordings, RingsAreOrderedFromTheTopDown) {
  if (!std::filesystem::exists(sequence_04())) GTEST_SKIP() << "no recordings";
  const auto frames = all_frames(sequence_04());
  for (std::size_t i = 0; i < frames.size(); i += 10) {
    for (int ring = 1; ring < 64; ++ring) {
      EXPECT_LT(median_elevation(frames[i].sweep, ring),
                median_elevation(frames[i].sweep, ring - 1) + 0.004)
          << "frame " << i << " ring " << ring;
    }
  }
}

TEST(KittiRecordings, SequenceCameraStandsWhereItsCalibrationSays) {
  if (!std::filesystem::exists(sequence_04())) GTEST_SKIP() << "no recordings";
  const auto source = open_dataset(sequence_04(), {});
  ASSERT_TRUE(source);
  const RigCalibration& rig = (*source)->calibration();
  EXPECT_EQ(rig.camera.width, 1226);
  EXPECT_EQ(rig.camera.height, 370);
  EXPECT_DOUBLE_EQ(rig.camera.fx, 707.0912);
  EXPECT_DOUBLE_EQ(rig.camera.cy, 183.1104);
  // The LiDAR stands 7 cm above and a third of a metre behind camera 0.
  EXPECT_TRUE(rig.T_camera_lidar.translation().isApprox(
      Eigen::Vector3d(-0.004784029760483, -0.07337429464231, -0.3339968064433), 1e-9));
}

TEST(KittiRecordings, KeepEveryFourthOrEighthRing) {
  if (!std::filesystem::exists(sequence_04())) GTEST_SKIP() << "no recordings";
  for (const int rays : {16, 8}) {
    const auto frames = all_frames(sequence_04(), {.rays = rays});
    for (const SynchronizedFrame& frame : frames) {
      const std::set<int> rings = rings_in(frame.sweep);
      ASSERT_EQ(rings.size(), static_cast<std::size_t>(rays));
      for (const int ring : rings) EXPECT_EQ(ring % (64 / rays), 0);
    }
  }
}

TEST(KittiRecordings, DriveHas154FramesOf64Rings) {
  if (!std::filesystem::exists(drive_0005())) GTEST_SKIP() << "no recordings";
  const auto frames = all_frames(drive_0005());
  ASSERT_EQ(frames.size(), 154U);
  for (const SynchronizedFrame& frame : frames) {
    EXPECT_TRUE(frame.faults.empty());
    EXPECT_FALSE(frame.sweep.motion_compensated);
    // The recording stopped within its last scan.
    EXPECT_EQ(rings_in(frame.sweep).size(), frame.sequence == 153 ? 53U : 64U) << frame.sequence;
  }
}

TEST(KittiRecordings, DriveIsTimedSoThatTheFrontIsMeasuredAtTheExposure) {
  if (!std::filesystem::exists(drive_0005())) GTEST_SKIP() << "no recordings";
  for (const SynchronizedFrame& frame : all_frames(drive_0005())) {
    for (const LidarReturn& point : frame.sweep.returns) {
      const double azimuth = std::atan2(point.p_lidar.y(), point.p_lidar.x());
      EXPECT_LT(std::abs(point.from_exposure_ns), 52'500'000);
      if (std::abs(azimuth) < 0.01) {
        EXPECT_LT(std::abs(point.from_exposure_ns), 300'000);
      }
      // Left of the middle is measured before the exposure.
      if (std::abs(azimuth) > 0.05) {
        EXPECT_EQ(point.from_exposure_ns<0, azimuth> 0);
      }
    }
  }
}

}  // namespace
}  // namespace sparsight
