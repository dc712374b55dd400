#include "tests/synthetic/noise.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace sparsight::synthetic {
namespace {

Eigen::Vector2d any_place() {
  return {*rc::gen::inRange(-100000, 100000) / 1000.0, *rc::gen::inRange(-100000, 100000) / 1000.0};
}

TEST(GradientNoise, VanishesOnItsLattice) {
  for (int u = -3; u < 3; ++u) EXPECT_NEAR(gradient_noise(u, 2.0, 5), 0.0, 1e-12);
}

TEST(GradientNoise, AveragesToZeroAndIsNotFlat) {
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const double value = gradient_noise(0.37 * i, 0.61 * i, 9);
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / kCount, 0.0, 0.02);
  EXPECT_GT(std::sqrt(squares / kCount), 0.25);
}

RC_GTEST_PROP(GradientNoise, IsContinuousAcrossCells, ()) {
  const Eigen::Vector2d p = any_place();
  const double step = 1e-6;
  RC_ASSERT(std::abs(gradient_noise(p.x() + step, p.y(), 3) - gradient_noise(p.x(), p.y(), 3)) <
            1e-5);
}

TEST(OctaveNoise, LeavesOutWhatTheFootprintCannotResolve) {
  const OctaveNoise noise{1.0, 0.01, 0.7, 4};
  EXPECT_EQ(noise({0.3, 0.4}, {0.6, 0.6}), 0.0);
  EXPECT_NE(noise({0.3, 0.4}, {0.01, 0.01}), 0.0);
}

RC_GTEST_PROP(CellNoise, FootprintAveragesSharpCells, ()) {
  const Eigen::Vector2d p = any_place();
  const Eigen::Vector2d cell(1.0, 0.5);
  const double width = *rc::gen::inRange(1, 400) / 1000.0;
  constexpr int kSamples = 60;
  double sum = 0.0;
  for (int i = 0; i < kSamples; ++i) {
    for (int j = 0; j < kSamples; ++j) {
      const Eigen::Vector2d offset((i + 0.5) / kSamples - 0.5, (j + 0.5) / kSamples - 0.5);
      sum += cell_noise(p + width * offset, cell, {0.0, 0.0}, 8);
    }
  }
  RC_ASSERT(std::abs(sum / (kSamples * kSamples) - cell_noise(p, cell, {width, width}, 8)) < 0.07);
}

TEST(PulseCoverage, CountsTheSharesOfWholeAndPartialPulses) {
  EXPECT_DOUBLE_EQ(pulse_coverage(0.1, 0.2, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(pulse_coverage(0.3, 0.2, 0.0), 0.0);
  EXPECT_NEAR(pulse_coverage(0.2, 0.2, 0.1), 0.5, 1e-12);
  EXPECT_NEAR(pulse_coverage(-7.3, 0.2, 5.0), 0.2, 1e-12);
}

TEST(StepCoverage, IsHalfAtTheEdge) {
  EXPECT_DOUBLE_EQ(step_coverage(2.0, 2.0, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(step_coverage(2.3, 2.0, 0.5), 1.0);
  EXPECT_DOUBLE_EQ(step_coverage(1.9, 2.0, 0.0), 0.0);
}

}  // namespace
}  // namespace sparsight::synthetic
