#include "hal/frame_source.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "drivers/datasets/kitti_odometry.h"
#include "drivers/datasets/kitti_raw.h"
#include "drivers/datasets/open_dataset.h"
#include "drivers/vlp16/vlp16_decoder.h"
#include "realtime/sync/rig_frame_source.h"
#include "tests/drivers/datasets/made_capture_folder.h"
#include "tests/drivers/datasets/small_dataset.h"
#include "tests/drivers/simulated/bare_room.h"
#include "tests/tools/session/made_walk.h"
#include "tools/session/open_source.h"

// What every FrameSource owes whoever reads it. A new implementation adds one line at the end.
namespace sparsight {
namespace {

struct Implementation {
  std::string name;
  std::function<std::unique_ptr<FrameSource>()> open;
  std::size_t left_out = 0;  // frames of its source whose exposure nobody can know
};

class FrameSourceContract : public ::testing::TestWithParam<Implementation> {
 protected:
  std::unique_ptr<FrameSource> source_ = GetParam().open();

  std::vector<SynchronizedFrame> all_frames() {
    std::vector<SynchronizedFrame> frames;
    while (auto frame = source_->next()) frames.push_back(std::move(*frame));
    return frames;
  }
};

TEST_P(FrameSourceContract, KnowsItsCamera) {
  const RigCalibration& rig = source_->calibration();
  EXPECT_GT(rig.camera.width, 0);
  EXPECT_GT(rig.camera.height, 0);
  EXPECT_GT(rig.camera.fx, 0);
  EXPECT_GT(rig.camera.fy, 0);
  const Eigen::Matrix3d R = rig.T_camera_lidar.linear();
  EXPECT_TRUE((R * R.transpose()).isIdentity(1e-9));
  EXPECT_NEAR(R.determinant(), 1.0, 1e-9);
  // A LiDAR looks ahead along x, a camera along z.
  EXPECT_GT((R * Eigen::Vector3d::UnitX()).z(), 0.5);
}

TEST_P(FrameSourceContract, YieldsAsManyFramesAsItSaid) {
  const auto announced = source_->frame_count();
  const std::size_t yielded = all_frames().size();
  EXPECT_GT(yielded, 0U);
  if (announced) {
    EXPECT_EQ(*announced, yielded + GetParam().left_out);
  }
}

TEST_P(FrameSourceContract, NumbersFramesWithoutGapsAndInTheOrderOfTheirExposure) {
  const auto frames = all_frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].sequence, i);
    if (i > 0) {
      EXPECT_GT(frames[i].exposure, frames[i - 1].exposure);
    }
  }
}

TEST_P(FrameSourceContract, GivesImagesOfTheCalibratedSizeOrNone) {
  const CameraIntrinsics& camera = source_->calibration().camera;
  const auto width = static_cast<std::size_t>(camera.width);
  const auto height = static_cast<std::size_t>(camera.height);
  for (const SynchronizedFrame& frame : all_frames()) {
    if (frame.grey.empty()) {
      EXPECT_FALSE(frame.faults.empty()) << "a missing image is named";
      EXPECT_FALSE(frame.color);
      continue;
    }
    EXPECT_EQ(frame.grey.width, camera.width);
    EXPECT_EQ(frame.grey.height, camera.height);
    EXPECT_EQ(frame.grey.pixels.size(), width * height);
    if (frame.color) {
      EXPECT_EQ(frame.color->rgb.size(), 3 * width * height);
    }
  }
}

TEST_P(FrameSourceContract, GivesFiniteReturnsRingByRingWithinASecondOfTheExposure) {
  for (const SynchronizedFrame& frame : all_frames()) {
    int last_ring = 0;
    for (const LidarReturn& point : frame.sweep.returns) {
      EXPECT_TRUE(point.p_lidar.allFinite());
      EXPECT_GT(point.p_lidar.norm(), 0.0F);
      EXPECT_TRUE(std::isfinite(point.intensity));
      EXPECT_LT(std::abs(point.from_exposure_ns), 1'000'000'000);
      if (frame.sweep.motion_compensated) {
        EXPECT_EQ(point.from_exposure_ns, 0);
      }
      EXPECT_GE(point.ring, last_ring);
      last_ring = point.ring;
    }
  }
}

TEST_P(FrameSourceContract, SaysWhatIsMissing) {
  for (const SynchronizedFrame& frame : all_frames()) {
    if (!frame.grey.empty() && !frame.sweep.returns.empty()) continue;
    ASSERT_FALSE(frame.faults.empty());
    EXPECT_FALSE(frame.faults.front().message.empty());
  }
}

TEST_P(FrameSourceContract, StaysAtItsEnd) {
  all_frames();
  EXPECT_FALSE(source_->next());
  EXPECT_FALSE(source_->next());
}

TEST_P(FrameSourceContract, GivesTheSameFramesEveryTime) {
  const auto once = all_frames();
  source_ = GetParam().open();
  const auto again = all_frames();
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].exposure, again[i].exposure);
    EXPECT_EQ(once[i].grey.pixels, again[i].grey.pixels);
    ASSERT_EQ(once[i].sweep.returns.size(), again[i].sweep.returns.size());
    for (std::size_t k = 0; k < once[i].sweep.returns.size(); ++k) {
      EXPECT_EQ(once[i].sweep.returns[k].p_lidar, again[i].sweep.returns[k].p_lidar);
      EXPECT_EQ(once[i].sweep.returns[k].from_exposure_ns,
                again[i].sweep.returns[k].from_exposure_ns);
    }
  }
}

// Data sets in which something is wrong with frames 1 and 2.
template <typename SmallDataset>
std::filesystem::path damaged_dataset() {
  static const SmallDataset dataset;
  std::filesystem::remove(dataset.image(1));
  std::filesystem::resize_file(dataset.scan(2), 100);
  return dataset.folder;
}

template <auto kIndex>
std::unique_ptr<FrameSource> folder_source(const std::filesystem::path& folder) {
  return std::make_unique<FolderSource>(kIndex(folder, std::nullopt).value(), std::nullopt);
}

// A rig's raw events, as they come from the simulated rig, from its recording, and from a capture
// with images of it.
const testing::MadeWalk& short_walk() {
  static const testing::MadeWalk kWalk = testing::MadeWalk::of(testing::small_options(0.7));
  return kWalk;
}

std::unique_ptr<FrameSource> rig_source(const SimulationOptions& options) {
  auto rig = std::make_unique<SimulatedRig>(options, testing::bare_room());
  const RigConfig config = rig->rig_config();
  return std::make_unique<RigFrameSource>(std::move(rig),
                                          std::make_unique<Vlp16Decoder>(config.lidar),
                                          config.calibration, sync_config(config));
}

SimulationOptions options_with_faults() {
  SimulationOptions options = testing::small_options(0.7);
  options.faults.lost_edges = 0.1;
  options.faults.lost_frames = 0.1;
  options.faults.lost_packets = 0.1;
  options.faults.away = {
      {DeviceKind::kLidar, std::chrono::milliseconds(300), std::chrono::milliseconds(300)}};
  return options;
}

std::unique_ptr<FrameSource> recorded_walk() {
  static const testing::TemporaryFolder kFolder;
  const auto file = kFolder.path() / "walk.mcap";
  if (!std::filesystem::exists(file)) {
    testing::write_recording(file, short_walk().events, short_walk().rig);
  }
  return open_source(file, {}).value().frames;
}

std::unique_ptr<FrameSource> captured_walk() {
  static const testing::TemporaryFolder kFolder;
  static const bool kWritten = (testing::write_capture_folder(kFolder.path(), short_walk()), true);
  EXPECT_TRUE(kWritten);
  return open_source(kFolder.path(), {}).value().frames;
}

std::unique_ptr<FrameSource> damaged_capture() {
  static const testing::MadeCaptureFolder kMade;
  testing::write_file(kMade.image(4), "no image");
  return open_source(kMade.folder, {}).value().frames;
}

INSTANTIATE_TEST_SUITE_P(
    FrameSources, FrameSourceContract,
    ::testing::Values(
        Implementation{"KittiOdometry",
                       [] {
                         static const testing::SmallSequence sequence;
                         return folder_source<index_kitti_odometry>(sequence.folder);
                       }},
        Implementation{"KittiOdometryInColour",
                       [] {
                         static const testing::SmallSequence sequence(2, CV_8UC3);
                         return folder_source<index_kitti_odometry>(sequence.folder);
                       }},
        Implementation{"KittiOdometryDamaged",
                       [] {
                         return folder_source<index_kitti_odometry>(
                             damaged_dataset<testing::SmallSequence>());
                       }},
        Implementation{"KittiRaw",
                       [] {
                         static const testing::SmallDrive drive;
                         return folder_source<index_kitti_raw>(drive.folder);
                       }},
        Implementation{
            "KittiRawDamaged",
            [] { return folder_source<index_kitti_raw>(damaged_dataset<testing::SmallDrive>()); }},
        Implementation{"SimulatedRig", [] { return rig_source(testing::small_options(0.7)); }},
        Implementation{"SimulatedRigInTrouble", [] { return rig_source(options_with_faults()); }},
        // The first eight vouch for each other.
        Implementation{"Recording", recorded_walk, 8}, Implementation{"Capture", captured_walk},
        Implementation{"CaptureDamaged", damaged_capture},
        Implementation{"Prefetching",
                       [] {
                         static const testing::SmallDrive drive;
                         return open_dataset(drive.folder, {}).value();
                       }}),
    [](const auto& suite) { return suite.param.name; });

}  // namespace
}  // namespace sparsight
