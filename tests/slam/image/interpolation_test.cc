#include "slam/image/interpolation.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tests/slam/analytic_image.h"
#include "tests/slam/random_values.h"

namespace sparsight {
namespace {

RC_GTEST_PROP(Interpolation, IsExactOnAffineImages, ()) {
  const GreyImage image =
      analytic_image(40, 30, [](double u, double v) { return 10.0 + 3.0 * u + 4.0 * v; });
  const auto u = static_cast<float>(any_between(1.0, 37.99));
  const auto v = static_cast<float>(any_between(1.0, 27.99));
  const ImageSample s = sample(image, u, v);
  RC_ASSERT(std::abs(s.value - (10.0F + 3.0F * u + 4.0F * v)) < 1e-4F);
  RC_ASSERT(sample_value(image, u, v) == s.value);
  RC_ASSERT(std::abs(s.du - 3.0F) < 1e-4F);
  RC_ASSERT(std::abs(s.dv - 4.0F) < 1e-4F);
}

// Bilinear in between: the twisted surface u v is met exactly, with its gradient (v, u).
RC_GTEST_PROP(Interpolation, IsExactOnATwistedSurface, ()) {
  const GreyImage image = analytic_image(16, 16, [](double u, double v) { return u * v; });
  const auto u = static_cast<float>(any_between(1.0, 13.99));
  const auto v = static_cast<float>(any_between(1.0, 13.99));
  const ImageSample s = sample(image, u, v);
  RC_ASSERT(std::abs(s.value - u * v) < 1e-4F);
  RC_ASSERT(sample_value(image, u, v) == s.value);
  RC_ASSERT(std::abs(s.du - v) < 1e-4F);
  RC_ASSERT(std::abs(s.dv - u) < 1e-4F);
}

TEST(Interpolation, GivesThePixelAndItsCentralDifferenceAtAPixelsCentre) {
  GreyImage image = analytic_image(5, 5, [](double, double) { return 0.0; });
  image.pixels = {0, 0,  0,  0,  0,  //
                  0, 0,  20, 0,  0,  //
                  0, 10, 77, 50, 0,  //
                  0, 0,  90, 0,  0,  //
                  0, 0,  0,  0,  0};
  const ImageSample s = sample(image, 2.0F, 2.0F);
  EXPECT_EQ(s.value, 77.0F);
  EXPECT_EQ(s.du, 20.0F);
  EXPECT_EQ(s.dv, 35.0F);
}

// Wavelength 40 px, amplitude 100: the central difference falls short by sinc(2 pi / 40), 0.4 %,
// the chord between pixels by (2 pi / 40)^2 / 8, 0.3 %, and rounding adds half a grey level.
RC_GTEST_PROP(Interpolation, FollowsASine, ()) {
  constexpr double kWave = 2.0 * M_PI / 40.0;
  const auto grey = [](double u, double v) {
    return 128.0 + 100.0 * std::sin(kWave * (0.8 * u + 0.6 * v));
  };
  const GreyImage image = analytic_image(80, 60, grey);
  const double u = any_between(1.0, 77.9);
  const double v = any_between(1.0, 57.9);
  const ImageSample s = sample(image, static_cast<float>(u), static_cast<float>(v));
  const double slope = 100.0 * kWave * std::cos(kWave * (0.8 * u + 0.6 * v));
  RC_ASSERT(std::abs(s.value - grey(u, v)) < 0.5 + 0.31);
  RC_ASSERT(std::abs(s.du - 0.8 * slope) < 0.5 + 0.12);
  RC_ASSERT(std::abs(s.dv - 0.6 * slope) < 0.5 + 0.12);
}

TEST(Interpolation, SamplesOnlyWhereItsNeighbourhoodLiesInTheImage) {
  const float below_one = std::nextafter(1.0F, 0.0F);
  EXPECT_TRUE(can_sample(10, 8, 1.0F, 1.0F));
  EXPECT_FALSE(can_sample(10, 8, below_one, 1.0F));
  EXPECT_FALSE(can_sample(10, 8, 1.0F, below_one));
  EXPECT_TRUE(can_sample(10, 8, std::nextafter(8.0F, 0.0F), std::nextafter(6.0F, 0.0F)));
  EXPECT_FALSE(can_sample(10, 8, 8.0F, 3.0F));
  EXPECT_FALSE(can_sample(10, 8, 3.0F, 6.0F));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(can_sample(10, 8, nan, 3.0F));
  EXPECT_FALSE(can_sample(10, 8, 3.0F, nan));
}

}  // namespace
}  // namespace sparsight
