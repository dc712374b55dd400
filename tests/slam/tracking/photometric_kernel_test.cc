#include "slam/tracking/photometric_kernel.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "slam/tracking/photometric_reference.h"
#include "tests/numeric_jacobian.h"
#include "tests/slam/instruction_set.h"
#include "tests/slam/random_values.h"
#include "tests/slam/sine_room.h"

namespace sparsight {
namespace {

constexpr double kDof = 5.0;

// Whether a product and a sum are rounded once (x86-64's older instruction sets round twice).
bool fuses(std::int64_t target) {
  return (target & (HWY_SSSE3 | HWY_SSE4 | HWY_EMU128 | HWY_SCALAR)) == 0;
}

// What one pass of the tracker computes.
struct Pass {
  Linearization linearization;
  NormalEquations equations;
  double sigma = 0.0;
  double cost = 0.0;
};

// A frame seen from elsewhere, darker, through a lens; some points are behind it, some outside.
struct View {
  explicit View(bool distorted) {
    if (distorted) {
      room.intrinsics.k1 = -0.25;
      room.intrinsics.k2 = 0.06;
      room.intrinsics.p1 = 0.001;
      room.intrinsics.p2 = -0.0015;
      room.intrinsics.k3 = -0.004;
    }
    const Eigen::Isometry3d T_world_keyframe = Eigen::Isometry3d::Identity();
    patches = room.keyframe(0, T_world_keyframe).patches[0];
    for (std::size_t i = 0; i < patches.entries(); ++i) {
      patches.weight[i] *= 0.25F + 0.05F * static_cast<float>(i % 16);
      if (i % 97 == 5) patches.z[i] = -patches.z[i];
    }
    T_camera_keyframe = pose(0.03, -0.12, 0.05, 0.15, -0.1, -0.8);
    image = room.image(T_camera_keyframe.inverse(), brightness);
  }

  Pass pass() const {
    Pass result;
    linearize(patches, image, room.camera(), T_camera_keyframe, brightness, result.linearization);
    result.sigma = estimate_sigma(result.linearization, kDof, 5.0);
    result.cost = robust_cost(result.linearization, kDof, 3.0);
    result.equations = accumulate(patches, result.linearization, kDof, 3.0);
    return result;
  }

  SineRoom room;
  PatchSet patches;
  Eigen::Isometry3d T_camera_keyframe;
  Brightness brightness{0.9, 7.0};
  GreyImage image;
};

void expect_identical(const Pass& a, const Pass& b) {
  EXPECT_EQ(a.linearization.residual, b.linearization.residual);
  EXPECT_EQ(a.linearization.weight, b.linearization.weight);
  EXPECT_EQ(a.linearization.J, b.linearization.J);
  EXPECT_EQ(a.equations.H, b.equations.H);
  EXPECT_EQ(a.equations.b, b.equations.b);
  EXPECT_EQ(a.sigma, b.sigma);
  EXPECT_EQ(a.cost, b.cost);
}

// Single precision moves a pixel by about 1e-5 px, at 20 grey levels per pixel.
void expect_close(const Linearization& kernel, const Linearization& reference) {
  ASSERT_EQ(kernel.residual.size(), reference.residual.size());
  for (std::size_t i = 0; i < kernel.residual.size(); ++i) {
    ASSERT_EQ(kernel.weight[i], reference.weight[i]) << "entry " << i;
    ASSERT_NEAR(kernel.residual[i], reference.residual[i], 2e-3F) << "entry " << i;
    for (std::size_t k = 0; k < 6; ++k) {
      const float expected = reference.J[k][i];
      ASSERT_NEAR(kernel.J[k][i], expected, 0.05F + 2e-4F * std::abs(expected))
          << "entry " << i << ", column " << k;
    }
  }
}

class PhotometricKernel : public testing::TestWithParam<bool> {
 protected:
  const View view_{GetParam()};
};

// Entries are taken many at a time, and what is left over at the end.
TEST_P(PhotometricKernel, GivesAnEntryTheSameWhateverNumberFollowsIt) {
  const Linearization all = view_.pass().linearization;
  for (const std::size_t entries : {16U, 112U, 128U, 144U, 272U}) {
    ASSERT_LT(entries, all.residual.size());
    PatchSet fewer = view_.patches;
    fewer.patches = entries / kPatternSize;
    for (std::vector<float>* column :
         {&fewer.x, &fewer.y, &fewer.z, &fewer.intensity, &fewer.weight}) {
      column->resize(entries);
    }
    Linearization some;
    linearize(fewer, view_.image, view_.room.camera(), view_.T_camera_keyframe, view_.brightness,
              some);
    const auto is_start_of = [](const std::vector<float>& a, const std::vector<float>& b) {
      return std::equal(a.begin(), a.end(), b.begin());
    };
    EXPECT_EQ(some.residual.size(), entries);
    EXPECT_TRUE(is_start_of(some.residual, all.residual)) << entries;
    EXPECT_TRUE(is_start_of(some.weight, all.weight)) << entries;
    for (std::size_t k = 0; k < 6; ++k) EXPECT_TRUE(is_start_of(some.J[k], all.J[k])) << entries;
  }
}

TEST_P(PhotometricKernel, AgreesWithTheReferenceOnEveryInstructionSet) {
  Linearization expected;
  reference::linearize(view_.patches, view_.image, view_.room.camera(), view_.T_camera_keyframe,
                       view_.brightness, expected);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    const InstructionSet only(target);
    const Pass pass = view_.pass();
    expect_close(pass.linearization, expected);
    // The sums over one and the same linearisation.
    Linearization l = pass.linearization;
    sum_patches(l);
    EXPECT_NEAR(pass.sigma, reference::estimate_sigma(l, kDof, 5.0), 2e-3 * pass.sigma);
    EXPECT_NEAR(pass.cost, reference::robust_cost(l, kDof, 3.0), 1e-5 * pass.cost);
    double log_sum = 0.0;
    for (std::size_t patch = 0; patch < l.patch_squares.size(); ++patch) {
      log_sum += (kDof + l.patch_pixels[patch]) * std::log1p(0.1 * l.patch_squares[patch]);
    }
    EXPECT_NEAR(patch_log_sum(l, kDof, 0.1), log_sum, 1e-9 * log_sum);
    const NormalEquations sums = reference::accumulate(view_.patches, l, kDof, 3.0);
    const Eigen::Matrix<double, 8, 1> scale = sums.H.diagonal().cwiseSqrt();
    const auto relative = scale.cwiseInverse().asDiagonal();
    EXPECT_LT((relative * (pass.equations.H - sums.H) * relative).norm(), 1e-5);
    EXPECT_LT((relative * (pass.equations.b - sums.b)).norm(), 1e-5 * (relative * sums.b).norm());
  }
}

// Results are those of the sixteen lanes, whatever the width of a register; a machine without fused
// multiply-add rounds otherwise, and agrees with its like.
TEST_P(PhotometricKernel, IsIdenticalBitForBitForEveryVectorWidth) {
  std::optional<Pass> fused;
  std::optional<Pass> twice_rounded;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    const InstructionSet only(target);
    std::optional<Pass>& known = fuses(target) ? fused : twice_rounded;
    if (known) {
      expect_identical(view_.pass(), *known);
    } else {
      known = view_.pass();
    }
  }
}

TEST_P(PhotometricKernel, GivesNoWeightToPointsBehindOrOutside) {
  const Pass pass = view_.pass();
  const Linearization& l = pass.linearization;
  std::size_t behind = 0;
  std::size_t outside = 0;
  for (std::size_t i = 0; i < view_.patches.entries(); ++i) {
    const Eigen::Vector3d q =
        view_.T_camera_keyframe *
        Eigen::Vector3d(view_.patches.x[i], view_.patches.y[i], view_.patches.z[i]);
    Eigen::Vector2d pixel;
    if (view_.patches.weight[i] == 0.0F) continue;
    if (q.z() <= 0.0) {
      ++behind;
    } else if (!view_.room.camera().project(q, pixel) ||
               !view_.room.camera().contains(pixel, 0.9)) {
      ++outside;
    } else {
      continue;
    }
    EXPECT_EQ(l.weight[i], 0.0F);
    EXPECT_EQ(l.residual[i], 0.0F);
    for (const std::vector<float>& column : l.J) EXPECT_EQ(column[i], 0.0F);
  }
  EXPECT_GT(behind, 10U);
  EXPECT_GT(outside, 100U);
  EXPECT_LT(visible_share(view_.patches, l), 0.97);
  EXPECT_GT(visible_share(view_.patches, l), 0.5);
}

INSTANTIATE_TEST_SUITE_P(Lenses, PhotometricKernel, testing::Bool(),
                         [](const auto& lens) { return lens.param ? "Distorted" : "Rectified"; });

// The kernel's gradient is a difference over two pixels, and grey levels are rounded: a step of
// about a pixel makes both small, not zero.
TEST(PhotometricKernelJacobian, IsTheDerivativeOfTheResidual) {
  const View view(true);
  const auto residual_at = [&](const Eigen::VectorXd& xi) -> Eigen::VectorXd {
    Linearization l;
    linearize(view.patches, view.image, view.room.camera(),
              exp_se3(Vector6d(xi)) * view.T_camera_keyframe, view.brightness, l);
    return Eigen::Map<const Eigen::VectorXf>(l.residual.data(),
                                             static_cast<Eigen::Index>(l.residual.size()))
        .cast<double>();
  };
  Eigen::MatrixXd numeric(view.patches.entries(), 6);
  numeric.leftCols<3>() = numeric_jacobian(residual_at, 6, 1.0 / 120.0).leftCols<3>();
  numeric.rightCols<3>() = numeric_jacobian(residual_at, 6, 3.0 / 120.0).rightCols<3>();
  Linearization l;
  linearize(view.patches, view.image, view.room.camera(), view.T_camera_keyframe, view.brightness,
            l);
  for (Eigen::Index k = 0; k < 6; ++k) {
    double error = 0.0;
    double size = 0.0;
    double product = 0.0;
    for (Eigen::Index i = 0; i < numeric.rows(); ++i) {
      const auto entry = static_cast<std::size_t>(i);
      Eigen::Vector2d pixel;
      const Eigen::Vector3d q =
          view.T_camera_keyframe *
          Eigen::Vector3d(view.patches.x[entry], view.patches.y[entry], view.patches.z[entry]);
      // Steps must not carry the point over the image's border.
      if (!view.room.camera().project(q, pixel) || !view.room.camera().contains(pixel, 5.0)) {
        continue;
      }
      const double J = l.J[static_cast<std::size_t>(k)][entry];
      error += (J - numeric(i, k)) * (J - numeric(i, k));
      size += numeric(i, k) * numeric(i, k);
      product += J * numeric(i, k);
    }
    EXPECT_GT(size, 0.0);
    EXPECT_LT(std::sqrt(error / size), 0.13) << "column " << k;
    EXPECT_NEAR(product / size, 1.0, 0.04) << "column " << k;
  }
}

TEST(PhotometricKernelResidual, FallsToRoundingAtTheTruePose) {
  const View view(true);
  const Pass pass = view.pass();
  double squares = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < view.patches.entries(); ++i) {
    // Patches in a corner of the room are bent: only their centres are exact.
    if (i % kPatternSize != 0 || pass.linearization.weight[i] == 0.0F) continue;
    squares += pass.linearization.residual[i] * pass.linearization.residual[i];
    weights += 1.0;
  }
  EXPECT_GT(weights, 100.0);
  EXPECT_LT(std::sqrt(squares / weights), 0.8);
}

TEST(PhotometricKernelInput, GivesNoWeightToWhatIsNotANumber) {
  View view(false);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  view.patches.x[8] = nan;
  view.patches.y[17] = nan;
  view.patches.z[26] = nan;
  view.patches.x[35] = infinity;
  view.patches.z[44] = infinity;
  view.patches.z[53] = -infinity;
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    const InstructionSet only(target);
    const Pass pass = view.pass();
    for (const std::size_t i : {8U, 17U, 26U, 35U, 44U, 53U}) {
      EXPECT_EQ(pass.linearization.weight[i], 0.0F) << i;
      EXPECT_EQ(pass.linearization.residual[i], 0.0F) << i;
    }
    EXPECT_TRUE(pass.equations.H.allFinite());
    EXPECT_TRUE(pass.equations.b.allFinite());
  }
}

Linearization samples(const std::vector<double>& residuals) {
  Linearization l;
  l.resize((residuals.size() + 15) / 16 * 16);
  for (std::size_t i = 0; i < l.residual.size(); ++i) {
    l.residual[i] = i < residuals.size() ? static_cast<float>(residuals[i]) : 1000.0F;
    l.weight[i] = i < residuals.size() ? 1.0F : 0.0F;
  }
  return l;
}

// 20,000 draws: the scale's own deviation is sqrt((nu + 3) / (2 nu n)) = 0.6 %.
TEST(EstimateSigma, FindsTheScaleOfATDistribution) {
  for (const double scale : {0.8, 4.0, 25.0}) {
    std::mt19937 random(7);
    std::student_t_distribution<double> draw(kDof);
    std::vector<double> residuals(20000);
    for (double& r : residuals) r = scale * draw(random);
    for (const double start : {0.3, 5.0, 100.0}) {
      EXPECT_NEAR(estimate_sigma(samples(residuals), kDof, start), scale, 0.03 * scale);
    }
  }
}

TEST(EstimateSigma, IsHardlyMovedByOutliers) {
  std::mt19937 random(9);
  std::normal_distribution<double> draw(0.0, 3.0);
  std::vector<double> residuals(10000);
  for (double& r : residuals) r = draw(random);
  const double clean = estimate_sigma(samples(residuals), kDof, 5.0);
  for (std::size_t i = 0; i < residuals.size(); i += 20) residuals[i] = 150.0;
  EXPECT_LT(estimate_sigma(samples(residuals), kDof, 5.0), 1.25 * clean);
}

TEST(EstimateSigma, KnowsNoLessThanQuantisationAndNothingFromNoPixels) {
  EXPECT_EQ(estimate_sigma(samples(std::vector<double>(64, 0.0)), kDof, 5.0), kMinSigma);
  EXPECT_EQ(estimate_sigma(samples({}), kDof, 5.0), 5.0);
  EXPECT_EQ(robust_cost(samples({}), kDof, 5.0), std::numeric_limits<double>::infinity());
}

RC_GTEST_PROP(RobustCost, GrowsWithEveryResidualAndLessThanItsSquare, ()) {
  std::vector<double> residuals(20);
  for (double& r : residuals) r = any_between(-200.0, 200.0);
  const double sigma = any_between(0.3, 30.0);
  const double cost = robust_cost(samples(residuals), kDof, sigma);
  double squares = 0.0;
  for (const double r : residuals) squares += r * r / 20.0;
  RC_ASSERT(cost <= 0.5 * (kDof + 1.0) / kDof * squares * (1.0 + 1e-5) + 1e-9);
  const auto worse = static_cast<std::size_t>(*rc::gen::inRange(0, 20));
  residuals[worse] += std::copysign(any_between(1.0, 50.0), residuals[worse]);
  RC_ASSERT(robust_cost(samples(residuals), kDof, sigma) > cost);
}

// The step solves H xi = -b; b must be the slope of the cost that the step is judged by.
TEST(RobustCost, HasTheNormalEquationsRightSideForItsSlope) {
  const View view(true);
  const double sigma = 3.0;
  const Pass pass = view.pass();
  double weights = 0.0;
  for (const float weight : pass.linearization.weight) weights += static_cast<double>(weight);
  // Along the linearisation itself, brightness last.
  const auto cost_at = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
    Linearization moved = pass.linearization;
    for (std::size_t i = 0; i < moved.residual.size(); ++i) {
      double r = moved.residual[i] - d(6) * view.patches.intensity[i] - d(7);
      for (std::size_t k = 0; k < 6; ++k) r += moved.J[k][i] * d(static_cast<Eigen::Index>(k));
      moved.residual[i] = static_cast<float>(r);
    }
    return Eigen::VectorXd::Constant(1, weights * reference::robust_cost(moved, kDof, sigma));
  };
  const Eigen::VectorXd slope = numeric_jacobian(cost_at, 8, 1e-3).transpose();
  const Eigen::Matrix<double, 8, 1> scale = pass.equations.H.diagonal().cwiseSqrt();
  for (Eigen::Index k = 0; k < 8; ++k) {
    EXPECT_NEAR(slope(k), pass.equations.b(k), 0.02 * scale(k)) << "row " << k;
  }
}

}  // namespace
}  // namespace sparsight
