#include "slam/geometry/arctangent.h"

#include <gtest/gtest.h>

#include <limits>

namespace sparsight {
namespace {

TEST(Arctangent, IsThatOfTheLibraryAllAround) {
  double worst = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const double angle = (i - 100000) * 1e-5 * M_PI;
    for (const double length : {1e-6, 1.0, 250.0}) {
      const auto x = static_cast<float>(length * std::cos(angle));
      const auto y = static_cast<float>(length * std::sin(angle));
      worst = std::max(worst, std::abs(std::atan2(double{y}, double{x}) - arctangent(y, x)));
    }
  }
  EXPECT_LT(worst, 3e-7);
}

TEST(Arctangent, IsExactOnTheAxes) {
  EXPECT_EQ(arctangent(0.0F, 2.0F), 0.0F);
  EXPECT_EQ(arctangent(2.0F, 0.0F), static_cast<float>(M_PI_2));
  EXPECT_EQ(arctangent(0.0F, -2.0F), static_cast<float>(M_PI));
  EXPECT_EQ(arctangent(-0.0F, -2.0F), static_cast<float>(-M_PI));
  EXPECT_EQ(arctangent(-2.0F, 0.0F), static_cast<float>(-M_PI_2));
}

TEST(Arctangent, OfWhatHasNoDirectionIsAnAngle) {
  const float infinity = std::numeric_limits<float>::infinity();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(arctangent(0.0F, 0.0F), 0.0F);
  EXPECT_EQ(arctangent(infinity, -infinity), 0.0F);
  EXPECT_TRUE(std::isfinite(arctangent(nan, 1.0F)));
  EXPECT_TRUE(std::isfinite(arctangent(1.0F, nan)));
}

}  // namespace
}  // namespace sparsight
