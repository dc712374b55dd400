#include "slam/image/pyramid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/slam/analytic_image.h"
#include "tests/slam/instruction_set.h"

namespace sparsight {
namespace {

TEST(ImagePyramid, HalvesByMeansRoundedToNearest) {
  GreyImage image = analytic_image(32, 32, [](double, double) { return 0.0; });
  image.pixels[0] = 1;
  image.pixels[2] = 1;
  image.pixels[3] = 1;
  image.pixels[4] = 255;
  image.pixels[5] = 255;
  image.pixels[32 + 4] = 255;
  image.pixels[32 + 5] = 255;
  const ImagePyramid pyramid(image, 2);
  ASSERT_EQ(pyramid.levels(), 2);
  EXPECT_EQ(pyramid.level(1).at(0, 0), 0) << "1/4";
  EXPECT_EQ(pyramid.level(1).at(1, 0), 1) << "2/4, upwards";
  EXPECT_EQ(pyramid.level(1).at(2, 0), 255) << "no overflow";
}

TEST(ImagePyramid, IsTheSameForEveryWidthOnEveryInstructionSet) {
  std::mt19937 random(3);
  for (const int width : {32, 34, 62, 65, 100, 161}) {
    const GreyImage image = analytic_image(
        width, 32, [&](double, double) { return static_cast<double>(random() % 256); });
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      SCOPED_TRACE(hwy::TargetName(target));
      const InstructionSet only(target);
      const ImagePyramid pyramid(image, 2);
      for (int v = 0; v < 16; ++v) {
        for (int u = 0; u < width / 2; ++u) {
          const int sum = image.at(2 * u, 2 * v) + image.at(2 * u + 1, 2 * v) +
                          image.at(2 * u, 2 * v + 1) + image.at(2 * u + 1, 2 * v + 1);
          ASSERT_EQ(pyramid.level(1).at(u, v), (sum + 2) / 4) << width << ": " << u << ", " << v;
        }
      }
    }
  }
}

TEST(ImagePyramid, KeepsAnAffineImageAffineAboutPixelCentres) {
  const ImagePyramid pyramid(
      analytic_image(64, 48, [](double u, double v) { return 2.0 * u + 2.0 * v + 4.0; }), 2);
  // Coarse (u, v) stands at fine (2 u + 1/2, 2 v + 1/2).
  for (int v = 0; v < 24; ++v) {
    for (int u = 0; u < 32; ++u) ASSERT_EQ(pyramid.level(1).at(u, v), 4 * u + 4 * v + 6);
  }
}

TEST(ImagePyramid, LeavesOutTheLastRowAndColumnOfOddSizes) {
  const ImagePyramid pyramid(
      analytic_image(67, 35, [](double u, double v) { return u > 65 || v > 33 ? 255.0 : 10.0; }),
      2);
  ASSERT_EQ(pyramid.levels(), 2);
  EXPECT_EQ(pyramid.level(1).width, 33);
  EXPECT_EQ(pyramid.level(1).height, 17);
  for (const std::uint8_t pixel : pyramid.level(1).pixels) ASSERT_EQ(pixel, 10);
}

TEST(ImagePyramid, MakesNoLevelUnderSixteenPixels) {
  const auto levels = [](int width, int height) {
    return ImagePyramid(analytic_image(width, height, [](double, double) { return 0.0; }), 9)
        .levels();
  };
  EXPECT_EQ(levels(64, 64), 3);
  EXPECT_EQ(levels(640, 63), 2);
  EXPECT_EQ(levels(31, 640), 1);
}

TEST(ImagePyramid, AlwaysHasTheImageItself) {
  const GreyImage image = analytic_image(20, 17, [](double u, double v) { return u + v; });
  const ImagePyramid pyramid(image, 0);
  ASSERT_EQ(pyramid.levels(), 1);
  EXPECT_EQ(pyramid.level(0).pixels, image.pixels);
  EXPECT_TRUE(ImagePyramid().empty());
}

TEST(ImagePyramid, TakesAnotherImageAsIfItWereNew) {
  const auto wave = [](double u, double v) { return 100.0 + 50.0 * std::sin(0.2 * u + 0.1 * v); };
  const auto dark = [](double, double) { return 7.0; };
  ImagePyramid reused(analytic_image(200, 120, wave), 4);
  for (const int width : {200, 64, 200}) {
    const GreyImage image = analytic_image(width, 120, dark);
    reused.assign(image, 4);
    const ImagePyramid fresh(image, 4);
    ASSERT_EQ(reused.levels(), fresh.levels());
    for (int level = 0; level < fresh.levels(); ++level) {
      EXPECT_EQ(reused.level(level).width, fresh.level(level).width);
      EXPECT_EQ(reused.level(level).pixels, fresh.level(level).pixels);
    }
  }
  reused.clear();
  EXPECT_TRUE(reused.empty());
}

}  // namespace
}  // namespace sparsight
