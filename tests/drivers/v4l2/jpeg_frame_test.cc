#include "drivers/v4l2/jpeg_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

namespace sparsight {
namespace {

using JpegBytes = std::vector<std::uint8_t>;
using ::testing::HasSubstr;

cv::Mat slope_image(int type) {
  cv::Mat image(48, 64, type);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols * image.channels(); ++u) {
      image.ptr(v)[u] = static_cast<std::uint8_t>(2 * u / image.channels() + 2 * v);
    }
  }
  return image;
}

JpegBytes jpeg_of(const cv::Mat& image, std::vector<int> parameters = {}) {
  JpegBytes bytes;
  cv::imencode(".jpg", image, bytes, parameters);
  return bytes;
}

CameraFrame jpeg_frame(JpegBytes bytes) {
  CameraFrame frame;
  frame.sequence = 7;
  frame.format = PixelFormat::kMjpeg;
  frame.width = 64;
  frame.height = 48;
  frame.bytes = std::move(bytes);
  return frame;
}

// Where the first segment of a kind begins.
std::size_t marker_position(const JpegBytes& bytes, std::uint8_t marker) {
  for (std::size_t i = 2; i + 3 < bytes.size();) {
    if (bytes[i + 1] == marker) return i;
    i += 2 + bytes[i + 2] * std::size_t{256} + bytes[i + 3];
  }
  ADD_FAILURE() << "no such marker";
  return 0;
}

// As cameras for video send them: the tables of Annex K are left for the receiver to know.
JpegBytes without_huffman_tables(JpegBytes bytes) {
  for (int i = 0; i < 2; ++i) {
    const std::size_t at = marker_position(bytes, 0xC4);
    const std::size_t length = 2 + bytes[at + 2] * std::size_t{256} + bytes[at + 3];
    bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                bytes.begin() + static_cast<std::ptrdiff_t>(at + length));
  }
  return bytes;
}

TEST(JpegFrame, IsReadInGreyAndInColor) {
  const auto grey = decode_jpeg_frame(jpeg_frame(jpeg_of(slope_image(CV_8UC1))));
  ASSERT_TRUE(grey) << grey.error().message;
  EXPECT_FALSE(grey->color);
  EXPECT_EQ(grey->grey.width, 64);
  EXPECT_EQ(grey->grey.height, 48);
  EXPECT_NEAR(grey->grey.at(10, 20), 60, 4);
  const auto color = decode_jpeg_frame(jpeg_frame(jpeg_of(slope_image(CV_8UC3))));
  ASSERT_TRUE(color) << color.error().message;
  ASSERT_TRUE(color->color);
  EXPECT_EQ(color->color->rgb.size(), 3U * 64 * 48);
  EXPECT_NEAR(color->grey.at(10, 20), 60, 4);
}

TEST(JpegFrame, MayBeProgressiveHaveRestartsAndPaddingBehindIt) {
  for (const std::vector<int>& parameters : {std::vector<int>{cv::IMWRITE_JPEG_PROGRESSIVE, 1},
                                             std::vector<int>{cv::IMWRITE_JPEG_RST_INTERVAL, 2}}) {
    JpegBytes bytes = jpeg_of(slope_image(CV_8UC3), parameters);
    EXPECT_EQ(jpeg_extent(bytes)->bytes, bytes.size());
    bytes.resize(bytes.size() + 5000);
    const auto image = decode_jpeg_frame(jpeg_frame(bytes));
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_NEAR(image->grey.at(10, 20), 60, 4);
  }
}

TEST(JpegFrame, MayLeaveOutTheStandardHuffmanTables) {
  const JpegBytes whole = jpeg_of(slope_image(CV_8UC1));
  const auto image = decode_jpeg_frame(jpeg_frame(without_huffman_tables(whole)));
  ASSERT_TRUE(image) << image.error().message;
  EXPECT_EQ(image->grey.pixels, decode_jpeg_frame(jpeg_frame(whole))->grey.pixels);
}

TEST(JpegFrame, ThatIsCutOffAnywhereIsRefused) {
  const JpegBytes whole = jpeg_of(slope_image(CV_8UC1), {cv::IMWRITE_JPEG_RST_INTERVAL, 2});
  for (std::size_t kept = 0; kept < whole.size(); ++kept) {
    const JpegBytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(kept));
    const auto image = decode_jpeg_frame(jpeg_frame(cut));
    ASSERT_FALSE(image) << kept;
    EXPECT_THAT(image.error().message, HasSubstr("camera frame 7: its JPEG is cut off"));
  }
}

// Two transfers of USB lost within the picture: restart markers are out of their order.
// Decoders of other formats look for their names further on, as DICOM's does at byte 128.
TEST(JpegFrame, ThatDoesNotBeginAsOneIsRefused) {
  JpegBytes bytes = jpeg_of(slope_image(CV_8UC1));
  bytes.insert(bytes.begin(), 0xFF);
  EXPECT_FALSE(jpeg_extent(bytes));
}

TEST(JpegFrame, WithAHoleInItIsRefused) {
  JpegBytes bytes = jpeg_of(slope_image(CV_8UC1), {cv::IMWRITE_JPEG_RST_INTERVAL, 2});
  const std::size_t middle = bytes.size() / 2;
  std::size_t first = middle;
  while (!(bytes[first] == 0xFF && (bytes[first + 1] & 0xF8) == 0xD0)) ++first;
  std::size_t second = first + 2;
  while (!(bytes[second] == 0xFF && (bytes[second + 1] & 0xF8) == 0xD0)) ++second;
  bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(first),
              bytes.begin() + static_cast<std::ptrdiff_t>(second));
  EXPECT_FALSE(decode_jpeg_frame(jpeg_frame(bytes)));
}

TEST(JpegFrame, OfAnotherSizeThanAgreedIsRefusedBeforeItIsDecoded) {
  JpegBytes bytes = jpeg_of(slope_image(CV_8UC1));
  const std::size_t frame = marker_position(bytes, 0xC0);
  for (std::size_t i = 5; i < 9; ++i) bytes[frame + i] = 0xFF;  // 65535 x 65535
  const auto image = decode_jpeg_frame(jpeg_frame(bytes));
  ASSERT_FALSE(image);
  EXPECT_EQ(image.error().code, ErrorCode::kWrongSize);
  EXPECT_THAT(image.error().message, HasSubstr("65535 x 65535 pixels, but 64 x 48 were agreed"));
}

RC_GTEST_PROP(JpegFrame, GarbageIsRefusedOrGivesAnImageOfTheAgreedSize,
              (const std::vector<std::pair<std::uint16_t, std::uint8_t>>& damage)) {
  JpegBytes bytes = jpeg_of(slope_image(CV_8UC1), {cv::IMWRITE_JPEG_RST_INTERVAL, 2});
  for (const auto& [place, value] : damage) bytes[place % bytes.size()] = value;
  const auto image = decode_jpeg_frame(jpeg_frame(bytes));
  if (image) RC_ASSERT(image->grey.pixels.size() == 64U * 48U);
}

RC_GTEST_PROP(JpegFrame, BytesThatAreNoJpegAreRefused, (JpegBytes bytes)) {
  RC_ASSERT(!decode_jpeg_frame(jpeg_frame(bytes)));
  bytes.insert(bytes.begin(), {0xFF, 0xD8});
  RC_ASSERT(!decode_jpeg_frame(jpeg_frame(bytes)));
}

}  // namespace
}  // namespace sparsight
