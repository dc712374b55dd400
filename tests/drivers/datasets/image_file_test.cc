#include "drivers/datasets/image_file.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

namespace sparsight {
namespace {

std::string encoded(const cv::Mat& image, const std::string& extension = ".png") {
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension, image, bytes);
  return {bytes.begin(), bytes.end()};
}

TEST(ImageFile, KeepsEightBitGreyPixelForPixel) {
  cv::Mat image(5, 7, CV_8UC1);
  cv::randu(image, 0, 256);
  const auto decoded = decode_image(encoded(image), "a.png");
  ASSERT_TRUE(decoded);
  EXPECT_FALSE(decoded->color);
  ASSERT_EQ(decoded->grey.width, 7);
  ASSERT_EQ(decoded->grey.height, 5);
  for (int v = 0; v < 5; ++v) {
    for (int u = 0; u < 7; ++u) EXPECT_EQ(decoded->grey.at(u, v), image.at<std::uint8_t>(v, u));
  }
}

TEST(ImageFile, KeepsTheUpperBitsOfSixteenBitGrey) {
  cv::Mat image(2, 3, CV_16UC1, cv::Scalar(0));
  image.at<std::uint16_t>(1, 2) = 0xABCD;
  const auto decoded = decode_image(encoded(image), "a.png");
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->grey.at(2, 1), 0xAB);
  EXPECT_EQ(decoded->grey.at(0, 0), 0);
}

TEST(ImageFile, TurnsColourIntoRgbAndLuma) {
  for (const int type : {CV_8UC3, CV_8UC4}) {
    cv::Mat image(2, 3, type, cv::Scalar(0, 0, 0, 255));
    image.ptr(1)[image.channels() * 2 + 0] = 200;  // blue
    image.ptr(1)[image.channels() * 2 + 1] = 100;  // green
    image.ptr(1)[image.channels() * 2 + 2] = 50;   // red
    const auto decoded = decode_image(encoded(image), "a.png");
    ASSERT_TRUE(decoded);
    ASSERT_TRUE(decoded->color);
    const std::size_t pixel = 3 * (1 * 3 + 2);
    EXPECT_EQ(decoded->color->rgb[pixel + 0], 50);
    EXPECT_EQ(decoded->color->rgb[pixel + 1], 100);
    EXPECT_EQ(decoded->color->rgb[pixel + 2], 200);
    EXPECT_EQ(decoded->grey.at(2, 1), 96);  // 0.299 * 50 + 0.587 * 100 + 0.114 * 200 = 96.45
    EXPECT_EQ(decoded->grey.at(0, 0), 0);
  }
}

TEST(ImageFile, KeepsWhiteWhite) {
  const auto decoded = decode_image(encoded(cv::Mat(2, 2, CV_8UC3, cv::Scalar::all(255))), "a.png");
  ASSERT_TRUE(decoded);
  EXPECT_EQ(decoded->grey.at(1, 1), 255);
}

TEST(ImageFile, RefusesWhatIsNotAnImageByName) {
  for (const std::string bytes : {"", "x", "\x89PNG\r\n\x1a\n", "P5 1000000 1000000 255\n"}) {
    const auto decoded = decode_image(bytes, "folder/a.png");
    ASSERT_FALSE(decoded);
    EXPECT_EQ(decoded.error().code, ErrorCode::kMalformed);
    EXPECT_NE(decoded.error().message.find("folder/a.png"), std::string::npos);
  }
}

TEST(ImageFile, RefusesAnyTruncation) {
  cv::Mat image(60, 70, CV_8UC1);
  cv::randu(image, 0, 256);
  for (const char* extension : {".png", ".jpg"}) {
    const std::string bytes = encoded(image, extension);
    for (std::size_t kept = 0; kept < bytes.size(); kept += 97) {
      EXPECT_FALSE(decode_image(bytes.substr(0, kept), "a")) << extension << " " << kept;
    }
    EXPECT_TRUE(decode_image(bytes, "a"));
  }
}

}  // namespace
}  // namespace sparsight
