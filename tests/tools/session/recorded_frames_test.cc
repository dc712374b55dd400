#include "tools/session/recorded_frames.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "tests/drivers/datasets/small_dataset.h"
#include "tests/tools/session/made_walk.h"

namespace sparsight {
namespace {

using testing::MadeWalk;

// The walk of a camera that compresses; the cable eats the end of every tenth frame.
std::vector<RigEvent> compressed_walk() {
  std::vector<RigEvent> events = MadeWalk::shared().events;
  for (RigEvent& event : events) {
    auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&event);
    if (frame == nullptr) continue;
    auto compressed = std::make_shared<CameraFrame>(**frame);
    const cv::Mat image(compressed->height, compressed->width, CV_8UC1, compressed->bytes.data());
    std::vector<std::uint8_t> bytes;
    cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
    if (compressed->sequence % 10 == 9) bytes.resize(bytes.size() - 100);
    compressed->format = PixelFormat::kMjpeg;
    compressed->stride_bytes = 0;
    compressed->bytes = std::move(bytes);
    *frame = std::move(compressed);
  }
  return events;
}

TEST(RecordedFrames, OfACompressingCameraAreReadAndTheGarbledOnesRefusedAndCounted) {
  const testing::TemporaryFolder temporary;
  const auto file = temporary.path() / "walk.mcap";
  testing::write_recording(file, compressed_walk(), MadeWalk::shared().rig);
  auto source = open_recording(file, {});
  ASSERT_TRUE(source) << source.error().message;
  int read = 0;
  int refused = 0;
  while (const auto frame = source->frames->next()) {
    ++(frame->grey.empty() ? refused : read);
    if (!frame->grey.empty()) continue;
    ASSERT_FALSE(frame->faults.empty());
    EXPECT_THAT(frame->faults[0].message, ::testing::HasSubstr("its JPEG is cut off or garbled"));
  }
  EXPECT_EQ(refused, 6);
  EXPECT_GE(read, 45);
  EXPECT_THAT(source->remarks(), ::testing::Contains("6 frames could not be read"));
}

}  // namespace
}  // namespace sparsight
