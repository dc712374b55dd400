#include "realtime/sync/grey_image.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <vector>

namespace sparsight {
namespace {

CameraFrame frame_of(PixelFormat format, int width, int height, int stride,
                     std::vector<std::uint8_t> bytes) {
  CameraFrame frame;
  frame.format = format;
  frame.width = width;
  frame.height = height;
  frame.stride_bytes = stride;
  frame.bytes = std::move(bytes);
  return frame;
}

std::vector<std::uint8_t> grey_of(const CameraFrame& frame) {
  const auto image = convert_image(frame, true, {});
  EXPECT_TRUE(image);
  return image ? image->grey.pixels : std::vector<std::uint8_t>{};
}

TEST(GreyImage, LeavesOutTheEndsOfRows) {
  const auto frame = frame_of(PixelFormat::kGrey8, 2, 2, 3, {1, 2, 99, 3, 4});
  EXPECT_EQ(grey_of(frame), (std::vector<std::uint8_t>{1, 2, 3, 4}));
}

TEST(GreyImage, KeepsTheUpperBitsOfLongerWords) {
  // 0x3FF, 0x200; in words of 12 and 16 bits the same shares.
  EXPECT_EQ(grey_of(frame_of(PixelFormat::kGrey10, 2, 1, 4, {0xFF, 0x03, 0x00, 0x02})),
            (std::vector<std::uint8_t>{255, 128}));
  EXPECT_EQ(grey_of(frame_of(PixelFormat::kGrey12, 2, 1, 4, {0xFF, 0x0F, 0x00, 0x08})),
            (std::vector<std::uint8_t>{255, 128}));
  EXPECT_EQ(grey_of(frame_of(PixelFormat::kGrey16, 2, 1, 4, {0xFF, 0xFF, 0x00, 0x80})),
            (std::vector<std::uint8_t>{255, 128}));
}

TEST(GreyImage, TakesBitsAboveTheFormatsForWhite) {
  EXPECT_EQ(grey_of(frame_of(PixelFormat::kGrey10, 1, 1, 2, {0x00, 0x40})),
            (std::vector<std::uint8_t>{255}));
}

TEST(GreyImage, TakesTheLumaOfVideoFormats) {
  EXPECT_EQ(grey_of(frame_of(PixelFormat::kYuyv, 2, 1, 4, {10, 128, 20, 128})),
            (std::vector<std::uint8_t>{10, 20}));
  EXPECT_EQ(grey_of(frame_of(PixelFormat::kUyvy, 2, 1, 4, {128, 10, 128, 20})),
            (std::vector<std::uint8_t>{10, 20}));
  EXPECT_EQ(grey_of(frame_of(PixelFormat::kNv12, 2, 2, 2, {10, 20, 30, 40, 128, 128})),
            (std::vector<std::uint8_t>{10, 20, 30, 40}));
}

TEST(GreyImage, GivesVideoItsColors) {
  // Pure red, by BT.601 in limited range: Y 81, Cb 90, Cr 240.
  const std::array frames{frame_of(PixelFormat::kYuyv, 2, 2, 4, {81, 90, 81, 240, 81, 90, 81, 240}),
                          frame_of(PixelFormat::kUyvy, 2, 2, 4, {90, 81, 240, 81, 90, 81, 240, 81}),
                          frame_of(PixelFormat::kNv12, 2, 2, 2, {81, 81, 81, 81, 90, 240})};
  for (const CameraFrame& frame : frames) {
    const auto image = convert_image(frame, true, {});
    ASSERT_TRUE(image && image->color);
    ASSERT_EQ(image->color->rgb.size(), 12U);
    for (std::size_t i = 0; i < 12; i += 3) {
      EXPECT_NEAR(image->color->rgb[i], 255, 2);
      EXPECT_NEAR(image->color->rgb[i + 1], 0, 2);
      EXPECT_NEAR(image->color->rgb[i + 2], 0, 2);
    }
    EXPECT_FALSE(convert_image(frame, false, {})->color);
  }
}

// A mosaic of one colour is that colour everywhere, borders and corners included.
TEST(GreyImage, GivesAnEvenMosaicItsColorEverywhere) {
  struct Pattern {
    PixelFormat format;
    std::array<int, 4> channels;  // of the pixels of a square, row by row
  };
  const std::array patterns{Pattern{PixelFormat::kBayerRggb8, {0, 1, 1, 2}},
                            Pattern{PixelFormat::kBayerGrbg8, {1, 0, 2, 1}},
                            Pattern{PixelFormat::kBayerGbrg8, {1, 2, 0, 1}},
                            Pattern{PixelFormat::kBayerBggr8, {2, 1, 1, 0}}};
  const std::array<std::uint8_t, 3> color{200, 100, 40};
  for (const Pattern& pattern : patterns) {
    std::vector<std::uint8_t> bytes(6 * 5, 0);
    for (std::size_t v = 0; v < 6; ++v) {
      for (std::size_t u = 0; u < 4; ++u) {
        bytes[5 * v + u] = color[static_cast<std::size_t>(pattern.channels[2 * (v % 2) + u % 2])];
      }
    }
    const auto image = convert_image(frame_of(pattern.format, 4, 6, 5, bytes), true, {});
    ASSERT_TRUE(image && image->color);
    for (std::size_t i = 0; i < 24; ++i) {
      EXPECT_EQ(image->color->rgb[3 * i], 200);
      EXPECT_EQ(image->color->rgb[3 * i + 1], 100);
      EXPECT_EQ(image->color->rgb[3 * i + 2], 40);
      EXPECT_EQ(image->grey.pixels[i], 123);  // 0.299, 0.587, 0.114
    }
  }
}

TEST(GreyImage, RefusesSizesThatTheBytesDoNotHave) {
  const std::array frames{
      frame_of(PixelFormat::kGrey8, 0, 1, 1, {1}),
      frame_of(PixelFormat::kGrey8, -1, 1, 1, {1}),
      frame_of(PixelFormat::kGrey8, 2, 2, 1, {1, 2, 3, 4}),
      frame_of(PixelFormat::kGrey8, 2, 2, -2, {1, 2, 3, 4}),
      frame_of(PixelFormat::kGrey8, 2, 2, 2, {1, 2, 3}),
      frame_of(PixelFormat::kGrey8, 2'000'000'000, 2'000'000'000, 2'000'000'000, {1}),
      frame_of(PixelFormat::kGrey16, 2, 1, 4, {1, 2, 3}),
      frame_of(PixelFormat::kYuyv, 3, 1, 6, {1, 2, 3, 4, 5, 6}),
      frame_of(PixelFormat::kNv12, 2, 2, 2, {1, 2, 3, 4, 5}),
      frame_of(PixelFormat::kNv12, 2, 3, 2, std::vector<std::uint8_t>(12)),
      frame_of(PixelFormat::kBayerRggb8, 1, 2, 1, {1, 2})};
  for (const CameraFrame& frame : frames) {
    const auto image = convert_image(frame, true, {});
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().code, ErrorCode::kWrongSize);
  }
}

TEST(GreyImage, TakesTheLumaOfRgbAndKeepsItsColors) {
  const auto frame = frame_of(PixelFormat::kRgb8, 1, 2, 4, {50, 100, 200, 99, 255, 255, 255});
  const auto image = convert_image(frame, true, {});
  ASSERT_TRUE(image && image->color);
  EXPECT_EQ(image->grey.pixels, (std::vector<std::uint8_t>{96, 255}));
  EXPECT_EQ(image->color->rgb, (std::vector<std::uint8_t>{50, 100, 200, 255, 255, 255}));
  EXPECT_FALSE(convert_image(frame, false, {})->color);
}

TEST(GreyImage, HandsCompressedFramesToTheDecoderItIsGiven) {
  const auto frame = frame_of(PixelFormat::kMjpeg, 4, 4, 0, {0xFF, 0xD8});
  EXPECT_FALSE(convert_image(frame, false, {}));
  const auto image = convert_image(frame, false, [](const CameraFrame&) -> Result<ConvertedImage> {
    return ConvertedImage{.grey = {.width = 1, .height = 1, .pixels = {7}}};
  });
  ASSERT_TRUE(image);
  EXPECT_EQ(image->grey.at(0, 0), 7);
}

// Under the sanitizers this is where a read past the end would show.
RC_GTEST_PROP(GreyImage, ReadsAnyFrameOrRefusesIt,
              (std::uint8_t format, std::vector<std::uint8_t> bytes)) {
  const auto frame = frame_of(static_cast<PixelFormat>(format % 13), *rc::gen::inRange(-2, 12),
                              *rc::gen::inRange(-2, 12), *rc::gen::inRange(-2, 30), bytes);
  const auto image = convert_image(frame, true, {});
  if (!image) return;
  RC_ASSERT(image->grey.pixels.size() == static_cast<std::size_t>(frame.width * frame.height));
}

}  // namespace
}  // namespace sparsight
