#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "drivers/datasets/open_dataset.h"
#include "tests/drivers/datasets/recordings.h"

namespace sparsight {
namespace {

std::filesystem::path sequence_04() {
  return testing::recordings() / "kitti/odometry/sequences/04";
}
std::filesystem::path drive_0005() {
  return testing::recordings() / "kitti/raw/2011_09_26/2011_09_26_drive_0005_sync";
}

std::size_t rings_in(const Sweep& sweep) {
  return sweep.returns.empty() ? 0U : sweep.returns.back().ring + 1U;
}

TEST(KittiRecordings, OdometrySequenceHas51FramesOf64Rings) {
  if (!std::filesystem::exists(sequence_04())) GTEST_SKIP() << "no recordings";
  const auto source = open_dataset(sequence_04(), {});
  ASSERT_TRUE(source) << source.error().message;
  ASSERT_EQ((*source)->frame_count(), 51U);
  EXPECT_EQ((*source)->calibration().camera.width, 1226);
  EXPECT_EQ((*source)->calibration().camera.height, 370);
  std::size_t frames = 0;
  while (const auto frame = (*source)->next()) {
    EXPECT_EQ(frame->sequence, frames++);
    EXPECT_TRUE(frame->faults.empty());
    EXPECT_TRUE(frame->sweep.motion_compensated);
    EXPECT_EQ(rings_in(frame->sweep), 64U);
    EXPECT_EQ(frame->grey.pixels.size(), 1226U * 370U);
  }
  EXPECT_EQ(frames, 51U);
}

TEST(KittiRecordings, RawDriveHas154Frames) {
  if (!std::filesystem::exists(drive_0005())) GTEST_SKIP() << "no recordings";
  const auto source = open_dataset(drive_0005(), {});
  ASSERT_TRUE(source) << source.error().message;
  ASSERT_EQ((*source)->frame_count(), 154U);
  while (const auto frame = (*source)->next()) {
    EXPECT_TRUE(frame->faults.empty());
    EXPECT_FALSE(frame->sweep.motion_compensated);
  }
}

}  // namespace
}  // namespace sparsight
