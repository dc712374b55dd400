#include "tools/session/chart_axis.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

namespace sparsight {
namespace {

TEST(ChartAxis, TicksAreMultiplesOfOneTwoOrFive) {
  EXPECT_EQ(nice_ticks({0.0, 10.0}, 5).positions, (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(nice_ticks({-3.0, 12.0}, 4).positions, (std::vector<double>{0, 5, 10}));
  EXPECT_DOUBLE_EQ(nice_ticks({0.0, 0.029}, 6).step, 0.005);
}

TEST(ChartAxis, LabelsHaveTheDecimalsTheStepNeeds) {
  EXPECT_EQ((Ticks{.step = 0.005}.label(0.015)), "0.015");
  EXPECT_EQ((Ticks{.step = 0.2}.label(0.6000000001)), "0.6");
  EXPECT_EQ((Ticks{.step = 100}.label(300)), "300");
  EXPECT_EQ((Ticks{.step = 0.5}.label(-1e-17)), "0.0");
}

TEST(ChartAxis, CountsHaveNoFractions) {
  EXPECT_EQ(nice_ticks({0.0, 2.0}, 8, true).positions, (std::vector<double>{0, 1, 2}));
}

TEST(ChartAxis, RangeWithoutLengthStillHasAxes) {
  for (const Interval& range : {Interval{}, Interval{3.0, 3.0}, Interval{0.0, 0.0}}) {
    EXPECT_GE(nice_ticks(range, 5).positions.size(), 2U);
    EXPECT_GT(widened_to_ticks(range, 5).length(), 0.0);
  }
  EXPECT_EQ(widened_to_ticks({0.0, 0.0}, 5).min, 0.0);
}

TEST(ChartAxis, WhatIsNotANumberDoesNotWidenARange) {
  Interval range;
  range.include(std::numeric_limits<double>::quiet_NaN());
  range.include(std::numeric_limits<double>::infinity());
  EXPECT_TRUE(range.empty());
}

RC_GTEST_PROP(ChartAxis, TicksAreFewInsideTheRangeAndTheWidenedRangeHoldsIt, ()) {
  const double scale = std::pow(10.0, *rc::gen::inRange(-6, 7));
  const double min = scale * *rc::gen::inRange(-1000, 1000);
  const double length = scale * *rc::gen::inRange(1, 2000);
  const int most = *rc::gen::inRange(2, 20);
  const Interval range{min, min + length};
  const Ticks ticks = nice_ticks(range, most);
  RC_ASSERT(static_cast<int>(ticks.positions.size()) <= most + 1);
  for (const double position : ticks.positions) {
    RC_ASSERT(position >= range.min - 1e-6 * length && position <= range.max + 1e-6 * length);
  }
  const Interval widened = widened_to_ticks(range, most);
  RC_ASSERT(widened.min <= range.min + 1e-6 * length && widened.max >= range.max - 1e-6 * length);
  RC_ASSERT(widened.length() <= length + 2.001 * ticks.step);
}

}  // namespace
}  // namespace sparsight
