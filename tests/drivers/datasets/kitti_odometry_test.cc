#include "drivers/datasets/kitti_odometry.h"

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
using testing::SmallSequence;

std::vector<SynchronizedFrame> all_frames(const SmallSequence& sequence,
                                          const DatasetOptions& options = {}) {
  std::vector<SynchronizedFrame> frames;
  const auto source = open_dataset(sequence.folder, options);
  EXPECT_TRUE(source) << source.error().message;
  if (!source) return frames;
  while (auto frame = (*source)->next()) frames.push_back(std::move(*frame));
  EXPECT_EQ((*source)->frame_count(), frames.size());
  return frames;
}

std::string open_error(const SmallSequence& sequence, const DatasetOptions& options = {}) {
  const auto source = open_dataset(sequence.folder, options);
  return source ? "opened" : source.error().message;
}

// Frame 2 has one fault that says `text`; all others have none.
void expect_only_frame_2_faulty(const std::vector<SynchronizedFrame>& frames,
                                const std::string& text) {
  ASSERT_THAT(frames, SizeIs(5));
  for (const SynchronizedFrame& frame : frames) {
    if (frame.sequence == 2) {
      ASSERT_THAT(frame.faults, SizeIs(1));
      EXPECT_THAT(frame.faults[0].message, AllOf(HasSubstr("000002."), HasSubstr(text)));
    } else {
      EXPECT_THAT(frame.faults, IsEmpty());
      EXPECT_FALSE(frame.grey.empty());
      EXPECT_THAT(frame.sweep.returns, SizeIs(8 * 90));
    }
  }
}

TEST(KittiOdometry, YieldsEveryFrameWithItsTimeImageAndRings) {
  const SmallSequence sequence;
  const auto frames = all_frames(sequence);
  ASSERT_THAT(frames, SizeIs(5));
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].sequence, i);
    EXPECT_EQ(frames[i].exposure.time_since_epoch(), std::chrono::milliseconds(100 * i));
    EXPECT_EQ(frames[i].grey.at(0, 0), 255);
    EXPECT_EQ(frames[i].grey.at(39, 11), 10 * i);
    EXPECT_FALSE(frames[i].color);
    EXPECT_TRUE(frames[i].sweep.motion_compensated);
    EXPECT_EQ(frames[i].sweep.returns.back().ring, 7);
    EXPECT_EQ(frames[i].sweep.returns.back().from_exposure_ns, 0);
  }
}

TEST(KittiOdometry, PlacesTheFirstCameraByTr) {
  const SmallSequence sequence;
  const auto source = open_dataset(sequence.folder, {});
  ASSERT_TRUE(source);
  const RigCalibration& rig = (*source)->calibration();
  EXPECT_EQ(rig.camera.width, 40);
  EXPECT_EQ(rig.camera.height, 12);
  EXPECT_EQ(rig.camera.fx, 50);
  EXPECT_EQ(rig.camera.fy, 60);
  EXPECT_EQ(rig.camera.cx, 20);
  EXPECT_EQ(rig.camera.cy, 6);
  EXPECT_FALSE(rig.camera.distorted());
  // Ahead of the LiDAR, left and above it: ahead, left and above in the camera.
  EXPECT_TRUE((rig.T_camera_lidar * Eigen::Vector3d(10, 2, 3))
                  .isApprox(Eigen::Vector3d(-2 + 0.1, -3 - 0.2, 10 - 0.3)));
}

TEST(KittiOdometry, PlacesTheOtherCamerasByTheirProjection) {
  const SmallSequence sequence(2, CV_8UC3);
  const auto source = open_dataset(sequence.folder, {.camera = 2});
  ASSERT_TRUE(source) << source.error().message;
  // A point projects as P2 * Tr says.
  const Eigen::Vector3d p_lidar(10, 2, 3);
  const Eigen::Vector3d p_camera = (*source)->calibration().T_camera_lidar * p_lidar;
  const Eigen::Vector3d p_reference(-2 + 0.1, -3 - 0.2, 10 - 0.3);
  const double depth = p_reference.z() + 0.003;
  EXPECT_NEAR(p_camera.z(), depth, 1e-12);
  EXPECT_NEAR(50 * p_camera.x() / p_camera.z() + 20,
              (50 * p_reference.x() + 20 * p_reference.z() + 5) / depth, 1e-9);
  EXPECT_NEAR(60 * p_camera.y() / p_camera.z() + 6,
              (60 * p_reference.y() + 6 * p_reference.z() + 0.6) / depth, 1e-9);
}

TEST(KittiOdometry, TakesTheLowestCameraThatIsThere) {
  const SmallSequence sequence(3, CV_8UC3);
  const auto frames = all_frames(sequence);
  ASSERT_THAT(frames, SizeIs(5));
  ASSERT_TRUE(frames[1].color);
  // Written blue 10, green 20, red 30.
  const std::size_t last = frames[1].color->rgb.size();
  EXPECT_EQ(last, 3U * 40U * 12U);
  EXPECT_EQ(frames[1].color->rgb[last - 3], 30);
  EXPECT_EQ(frames[1].color->rgb[last - 2], 20);
  EXPECT_EQ(frames[1].color->rgb[last - 1], 10);
  EXPECT_EQ(frames[1].grey.at(39, 11), 22);  // 0.299 * 30 + 0.587 * 20 + 0.114 * 10
}

TEST(KittiOdometry, KeepsTheRaysAskedFor) {
  const SmallSequence sequence;
  const auto frames = all_frames(sequence, {.rays = 2});
  ASSERT_THAT(frames, SizeIs(5));
  EXPECT_THAT(frames[3].sweep.returns, SizeIs(2 * 90));
  EXPECT_EQ(frames[3].sweep.returns.back().ring, 4);
  EXPECT_THAT(all_frames(sequence, {.rays = 64})[0].sweep.returns, SizeIs(8 * 90));
}

TEST(KittiOdometry, ReadsJpegWhereThereIsNoPng) {
  const SmallSequence sequence;
  for (int i = 0; i < 5; ++i) {
    std::filesystem::path jpeg = sequence.image(i);
    testing::write_image(jpeg.replace_extension(".jpg"), testing::small_image(CV_8UC1, i));
    std::filesystem::remove(sequence.image(i));
  }
  const auto frames = all_frames(sequence);
  ASSERT_THAT(frames, SizeIs(5));
  EXPECT_NEAR(frames[4].grey.at(39, 11), 40, 3);
}

TEST(KittiOdometry, SkipsAMissingImage) {
  const SmallSequence sequence;
  std::filesystem::remove(sequence.image(2));
  const auto frames = all_frames(sequence);
  expect_only_frame_2_faulty(frames, "no such file");
  EXPECT_TRUE(frames[2].grey.empty());
  EXPECT_THAT(frames[2].sweep.returns, SizeIs(8 * 90));
}

TEST(KittiOdometry, KeepsThePlaceOfAMissingLastImage) {
  const SmallSequence sequence;
  std::filesystem::remove(sequence.image(4));
  const auto frames = all_frames(sequence);
  ASSERT_THAT(frames, SizeIs(5));
  EXPECT_TRUE(frames[4].grey.empty());
}

TEST(KittiOdometry, SkipsATruncatedImage) {
  for (const double share : {0.0, 0.2, 0.5, 0.8}) {
    const SmallSequence sequence;
    cv::Mat noise(12, 40, CV_8UC1);
    cv::randu(noise, 0, 255);
    testing::write_image(sequence.image(2), noise);
    testing::truncate_file(sequence.image(2), share);
    const auto frames = all_frames(sequence);
    expect_only_frame_2_faulty(frames, "truncated");
    EXPECT_TRUE(frames[2].grey.empty()) << share;
  }
}

TEST(KittiOdometry, SkipsAnImageOfTheWrongSizeEvenTheFirst) {
  for (const int wrong : {0, 2}) {
    const SmallSequence sequence;
    testing::write_image(sequence.image(wrong), testing::small_image(CV_8UC1, 1, 41, 12));
    const auto frames = all_frames(sequence);
    ASSERT_THAT(frames, SizeIs(5));
    for (const SynchronizedFrame& frame : frames) {
      const bool right = frame.sequence != static_cast<std::uint64_t>(wrong);
      EXPECT_THAT(frame.faults, SizeIs(right ? 0 : 1));
      EXPECT_EQ(frame.grey.empty(), !right);
    }
    EXPECT_THAT(frames[static_cast<std::size_t>(wrong)].faults[0].message,
                AllOf(HasSubstr("41 x 12"), HasSubstr("40 x 12")));
  }
}

TEST(KittiOdometry, SkipsAMissingScan) {
  const SmallSequence sequence;
  std::filesystem::remove(sequence.scan(2));
  const auto frames = all_frames(sequence);
  expect_only_frame_2_faulty(frames, "no such file");
  EXPECT_THAT(frames[2].sweep.returns, IsEmpty());
  EXPECT_FALSE(frames[2].grey.empty());
}

TEST(KittiOdometry, SkipsAScanThatEndsWithinAPoint) {
  const SmallSequence sequence;
  std::filesystem::resize_file(sequence.scan(2), 16 * 100 + 7);
  const auto frames = all_frames(sequence);
  expect_only_frame_2_faulty(frames, "1607 bytes");
  EXPECT_THAT(frames[2].sweep.returns, IsEmpty());
}

TEST(KittiOdometry, ReportsAnEmptyScan) {
  const SmallSequence sequence;
  testing::write_file(sequence.scan(2), "");
  expect_only_frame_2_faulty(all_frames(sequence), "without returns");
}

TEST(KittiOdometry, LeavesOutPointsThatAreNotNumbersAndSaysHowMany) {
  const SmallSequence sequence;
  auto points = testing::cylinder_scan(8);
  points[10][0] = std::numeric_limits<float>::quiet_NaN();
  points[20][2] = std::numeric_limits<float>::infinity();
  points[30] = {0, 0, 0, 0};
  testing::write_file(sequence.scan(2), testing::scan_bytes(points));
  const auto frames = all_frames(sequence);
  expect_only_frame_2_faulty(frames, "2 of 719 points");
  EXPECT_THAT(frames[2].sweep.returns, SizeIs(8 * 90 - 3));
}

TEST(KittiOdometry, SkipsAFolderWhereAFileShouldBe) {
  const SmallSequence sequence;
  std::filesystem::remove(sequence.image(2));
  std::filesystem::create_directory(sequence.image(2));
  expect_only_frame_2_faulty(all_frames(sequence), "not a regular file");
}

TEST(KittiOdometry, RefusesACalibrationWithoutTr) {
  const SmallSequence sequence;
  const std::string text = SmallSequence::calibration();
  testing::write_file(sequence.folder / "calib.txt", text.substr(0, text.find("Tr")));
  EXPECT_THAT(open_error(sequence), AllOf(HasSubstr("calib.txt"), HasSubstr("Tr")));
}

TEST(KittiOdometry, RefusesACalibrationWithoutTheCamera) {
  const SmallSequence sequence;
  const std::string text = SmallSequence::calibration();
  testing::write_file(sequence.folder / "calib.txt", text.substr(text.find("P1")));
  EXPECT_THAT(open_error(sequence), AllOf(HasSubstr("calib.txt"), HasSubstr("P0")));
}

TEST(KittiOdometry, NamesTheLineOfAMalformedCalibration) {
  const SmallSequence sequence;
  std::string text = SmallSequence::calibration();
  text.replace(text.find("0.1"), 3, "0,1");
  testing::write_file(sequence.folder / "calib.txt", text);
  EXPECT_THAT(open_error(sequence),
              AllOf(HasSubstr("calib.txt:5"), HasSubstr("Tr"), HasSubstr("0,1")));
}

TEST(KittiOdometry, RefusesAMissingCalibration) {
  const SmallSequence sequence;
  std::filesystem::remove(sequence.folder / "calib.txt");
  EXPECT_THAT(open_error(sequence), AllOf(HasSubstr("calib.txt"), HasSubstr("no such file")));
}

TEST(KittiOdometry, RefusesAPrincipalPointOutsideTheImage) {
  const SmallSequence sequence;
  testing::write_file(sequence.folder / "calib.txt",
                      "P0: 700 0 600 0 0 700 180 0 0 0 1 0\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n");
  EXPECT_THAT(open_error(sequence), AllOf(HasSubstr("principal point"), HasSubstr("40 x 12")));
}

TEST(KittiOdometry, RefusesFewerTimesThanImages) {
  const SmallSequence sequence;
  testing::write_file(sequence.folder / "times.txt", "0\n0.1\n0.2\n");
  EXPECT_THAT(open_error(sequence), AllOf(HasSubstr("times.txt"), HasSubstr("3 lines")));
}

TEST(KittiOdometry, RefusesTimesThatGoBackwards) {
  const SmallSequence sequence;
  testing::write_file(sequence.folder / "times.txt", "0\n0.1\n0.05\n0.3\n0.4\n");
  EXPECT_THAT(open_error(sequence), HasSubstr("times.txt:3"));
}

TEST(KittiOdometry, RefusesMalformedTimes) {
  const SmallSequence sequence;
  testing::write_file(sequence.folder / "times.txt", "0\n0.1\n0.2\nsoon\n0.4\n");
  EXPECT_THAT(open_error(sequence), AllOf(HasSubstr("times.txt:4"), HasSubstr("soon")));
}

TEST(KittiOdometry, RefusesASequenceWithoutImages) {
  const SmallSequence sequence;
  std::filesystem::remove_all(sequence.folder / "image_0");
  EXPECT_THAT(open_error(sequence), AllOf(HasSubstr("no images"), HasSubstr("image_N")));
}

TEST(KittiOdometry, RefusesASequenceOfUnreadableImages) {
  const SmallSequence sequence;
  for (int i = 0; i < 5; ++i) testing::write_file(sequence.image(i), "not an image");
  EXPECT_THAT(open_error(sequence), AllOf(HasSubstr("none of the 5 images"), HasSubstr("image_0")));
}

TEST(KittiOdometry, RefusesASequenceWithoutScans) {
  const SmallSequence sequence;
  std::filesystem::remove_all(sequence.folder / "velodyne");
  EXPECT_THAT(open_error(sequence), AllOf(HasSubstr("no scans"), HasSubstr("velodyne")));
}

TEST(KittiOdometry, NamesTheCamerasThereAre) {
  const SmallSequence sequence;
  EXPECT_THAT(open_error(sequence, {.camera = 2}), HasSubstr("there are cameras 0"));
}

}  // namespace
}  // namespace sparsight
