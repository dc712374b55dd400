#include "drivers/v4l2/frame_of_buffer.h"

#include <gtest/gtest.h>

#include "drivers/v4l2/pixel_format_code.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;

constexpr HostTime kArrival{1s};

CameraFrame frame_from(const std::vector<std::uint8_t>& memory, std::uint32_t bytes_used,
                       AgreedFormat format) {
  v4l2_buffer buffer{};
  buffer.bytesused = bytes_used;
  CameraFrame frame;
  frame_of_buffer(buffer, memory, format, kArrival, frame);
  return frame;
}

TEST(FrameOfBuffer, MoreBytesThanTheBufferHasAreNotRead) {
  const AgreedFormat format{.width = 4, .height = 2, .stride_bytes = 4};
  const CameraFrame frame = frame_from(std::vector<std::uint8_t>(6, 9), 4'000'000'000U, format);
  EXPECT_TRUE(frame.damaged);
  EXPECT_EQ(frame.bytes, (std::vector<std::uint8_t>{9, 9, 9, 9, 9, 9, 0, 0}));
}

TEST(FrameOfBuffer, PaddingBehindTheFrameIsLeftOut) {
  const AgreedFormat format{.width = 4, .height = 2, .stride_bytes = 4};
  const CameraFrame frame = frame_from(std::vector<std::uint8_t>(100, 9), 100, format);
  EXPECT_FALSE(frame.damaged);
  EXPECT_EQ(frame.bytes.size(), 8U);
}

TEST(FrameOfBuffer, ColourPlanesAreKept) {
  const AgreedFormat format{
      .format = PixelFormat::kNv12, .width = 4, .height = 2, .stride_bytes = 4};
  const CameraFrame frame = frame_from(std::vector<std::uint8_t>(12, 9), 12, format);
  EXPECT_FALSE(frame.damaged);
  EXPECT_EQ(frame.bytes.size(), 12U);
}

TEST(FrameOfBuffer, AJpegHasItsOwnLengthAndItsMark) {
  const AgreedFormat format{.format = PixelFormat::kMjpeg, .width = 4, .height = 2};
  const std::vector<std::uint8_t> memory{0xFF, 0xD8, 0xFF, 0xD9, 0, 0};
  EXPECT_EQ(frame_from(memory, 4, format).bytes.size(), 4U);
  EXPECT_FALSE(frame_from(memory, 4, format).damaged);
  EXPECT_TRUE(frame_from(memory, 0, format).damaged);
  EXPECT_TRUE(frame_from({0, 0xD8, 0xFF, 0xD9}, 4, format).damaged);
}

TEST(PixelFormatCode, EveryFormatStandsAtItsOwnPlaceUnderItsOwnName) {
  for (const PixelFormatCode& code : pixel_format_codes()) {
    EXPECT_EQ(&code_of(code.format), &code);
    EXPECT_EQ(format_of(code.fourcc), code.format);
    EXPECT_EQ(format_named(code.name), code.format);
  }
  EXPECT_FALSE(format_named("H264"));
  EXPECT_EQ(pixel_format_codes().back().format, PixelFormat::kMjpeg);
}

}  // namespace
}  // namespace sparsight
