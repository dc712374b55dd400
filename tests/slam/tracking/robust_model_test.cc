#include "slam/tracking/robust_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>

namespace sparsight {
namespace {

constexpr PhotometryConfig kPerPixel{.student_t_dof = 5.0, .patch_weights = false};
constexpr PhotometryConfig kPerPatch{.student_t_dof = 5.0, .patch_weights = true};

// Residuals by hand; every entry has weight 1 and a Jacobian of its own.
struct Sample {
  PatchSet patches;
  Linearization linearization;

  explicit Sample(std::size_t count) {
    patches.patches = count;
    const std::size_t entries = count * kPatternSize;
    patches.intensity.assign(entries, 100.0F);
    patches.x.assign(entries, 0.0F);
    linearization.resize(entries);
    std::mt19937 random(7);
    std::normal_distribution<float> normal;
    for (std::vector<float>& column : linearization.J) {
      for (float& value : column) value = normal(random);
    }
    set_weights(1.0F);
  }

  void set_weights(float weight) {
    linearization.weight.assign(linearization.weight.size(), weight);
    sum_patches(linearization);
  }

  void set_patch(std::size_t patch, float residual) {
    for (std::size_t i = 0; i < kPatternSize; ++i) {
      linearization.residual[patch * kPatternSize + i] = residual;
    }
    sum_patches(linearization);
  }
};

// A patch of the multivariate t-distribution: one scale for its eight normal residuals.
Sample drawn(double sigma, std::size_t count) {
  Sample sample(count);
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::chi_squared_distribution<double> chi2(5.0);
  for (std::size_t patch = 0; patch < count; ++patch) {
    const double scale = sigma / std::sqrt(chi2(random) / 5.0);
    for (std::size_t i = 0; i < kPatternSize; ++i) {
      sample.linearization.residual[patch * kPatternSize + i] =
          static_cast<float>(scale * normal(random));
    }
  }
  sum_patches(sample.linearization);
  return sample;
}

TEST(RobustModel, IsThePapersPerPixel) {
  const Sample s = drawn(4.0, 64);
  const Linearization& l = s.linearization;
  EXPECT_EQ(estimate_sigma(l, kPerPixel, 5.0), estimate_sigma(l, 5.0, 5.0));
  EXPECT_EQ(robust_cost(l, kPerPixel, 4.0), robust_cost(l, 5.0, 4.0));
  EXPECT_EQ(accumulate(s.patches, l, kPerPixel, 4.0).H, accumulate(s.patches, l, 5.0, 4.0).H);
}

TEST(RobustModel, FindsTheScaleOfPatchesFromAnyStart) {
  const Sample s = drawn(4.0, 4000);
  EXPECT_NEAR(estimate_sigma(s.linearization, kPerPatch, 0.5), 4.0, 0.12);
  EXPECT_NEAR(estimate_sigma(s.linearization, kPerPatch, 50.0), 4.0, 0.12);
}

TEST(RobustModel, WeighsAPatchByTheSumOfItsSquares) {
  Sample s(2);
  s.set_patch(0, 0.0F);
  s.set_patch(1, 6.0F);
  const double sigma = 2.0;
  const NormalEquations n = accumulate(s.patches, s.linearization, kPerPatch, sigma);
  // w = (nu + 8) / (nu + sum r^2 / sigma^2) by hand: 13/5 and 13/77.
  double expected = 0.0;
  for (std::size_t i = 0; i < 2 * kPatternSize; ++i) {
    const double w = i < kPatternSize ? 13.0 / 5.0 : 13.0 / 77.0;
    expected += w * std::pow(static_cast<double>(s.linearization.J[2][i]), 2);
  }
  EXPECT_NEAR(n.H(2, 2), expected, 1e-4 * expected);
}

TEST(RobustModel, LeavesAPatchThatDisagreesAsAWholeLessThanItsPixelsWouldKeep) {
  Sample s(64);
  for (std::size_t patch = 0; patch < 64; ++patch) s.set_patch(patch, patch < 44 ? 2.0F : 30.0F);
  const Linearization& l = s.linearization;
  EXPECT_LT(estimate_sigma(l, kPerPatch, 5.0), 0.75 * estimate_sigma(l, kPerPixel, 5.0));
}

TEST(RobustModel, CostFallsWithTheResiduals) {
  const Sample large = drawn(4.0, 64);
  const Sample small = drawn(3.0, 64);
  EXPECT_LT(robust_cost(small.linearization, kPerPatch, 4.0),
            robust_cost(large.linearization, kPerPatch, 4.0));
}

TEST(RobustModel, CostIsTheLikelihoodOfTheMultivariateTDistribution) {
  for (const std::size_t count : {1U, 3U, 64U}) {
    const Sample s = drawn(4.0, count);
    double expected = 0.0;
    for (std::size_t patch = 0; patch < count; ++patch) {
      double squares = 0.0;
      for (std::size_t i = 0; i < kPatternSize; ++i) {
        squares += std::pow(s.linearization.residual[patch * kPatternSize + i], 2);
      }
      expected += 0.5 * 9.0 * (5.0 + 8.0) * std::log1p(squares / (5.0 * 9.0));
    }
    EXPECT_NEAR(robust_cost(s.linearization, kPerPatch, 3.0),
                expected / static_cast<double>(count * kPatternSize), 1e-6 * expected);
  }
}

TEST(RobustModel, HasNoCostWithoutPixels) {
  Sample s(2);
  s.set_weights(0.0F);
  EXPECT_TRUE(std::isinf(robust_cost(s.linearization, kPerPatch, 4.0)));
}

}  // namespace
}  // namespace sparsight
