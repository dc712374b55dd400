#include "slam/tracking/photometric_alignment.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "tests/slam/sine_room.h"

namespace sparsight {
namespace {

class PhotometricAlignment : public testing::Test {
 protected:
  Alignment aligned(const GreyImage& image, const Alignment& start,
                    const PhotometryConfig& photometry = {}, const AlignmentConfig& config = {},
                    Information information = Information::kTold) {
    return align(keyframe_.patches[0], image, room_.camera(), keyframe_.mean_inverse_depth, start,
                 config, photometry, workspace_, information);
  }
  static Alignment from(const Eigen::Isometry3d& T_camera_keyframe) {
    Alignment start;
    start.T_camera_keyframe = T_camera_keyframe;
    return start;
  }

  const SineRoom room_{};
  const Keyframe keyframe_ = room_.keyframe(0, Eigen::Isometry3d::Identity());
  const Eigen::Isometry3d T_true_ = pose(0.01, -0.03, 0.015, 0.08, -0.05, -0.2);
  const GreyImage image_ = room_.image(T_true_.inverse());
  AlignmentWorkspace workspace_;
};

// Starts one to two pixels off, each along another direction.
TEST_F(PhotometricAlignment, FindsThePoseFromNearby) {
  for (int axis = 0; axis < 6; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const double off = sign * (axis < 3 ? 0.015 : 0.06);
      const Alignment at = aligned(image_, from(exp_se3(off * Vector6d::Unit(axis)) * T_true_));
      EXPECT_TRUE(at.converged);
      EXPECT_LT(turn_between(at.T_camera_keyframe, T_true_), 2e-4) << axis;
      EXPECT_LT(shift_between(at.T_camera_keyframe, T_true_), 1e-3) << axis;
      EXPECT_LT(at.sigma_grey, 1.0);
      EXPECT_GT(at.visible_share, 0.9);
    }
  }
}

TEST_F(PhotometricAlignment, ConvergesLongBeforeItsLimit) {
  const Alignment start = from(exp_se3(0.01 * Vector6d::Ones()) * T_true_);
  EXPECT_TRUE(aligned(image_, start, {}, {.max_iterations = 10}).converged);
  EXPECT_FALSE(aligned(image_, start, {}, {.max_iterations = 1}).converged);
}

TEST_F(PhotometricAlignment, StaysWhereItIsRight) {
  const Alignment at = aligned(image_, from(T_true_), {}, {.max_iterations = 3});
  EXPECT_TRUE(at.converged);
  EXPECT_LT(shift_between(at.T_camera_keyframe, T_true_), 1e-3);
}

TEST_F(PhotometricAlignment, NeverEndsAtAHigherCostThanItsStart) {
  const Alignment start = from(pose(0.2, -0.3, 0.1, 0.5, 0.5, 0.5));
  const Alignment before =
      assess(keyframe_.patches[0], image_, room_.camera(), start, {}, workspace_);
  const Alignment after = aligned(image_, start);
  const double cost_before_at_final_scale = [&] {
    assess(keyframe_.patches[0], image_, room_.camera(), start, {}, workspace_);
    return robust_cost(workspace_.current, 5.0, before.sigma_grey);
  }();
  assess(keyframe_.patches[0], image_, room_.camera(), after, {}, workspace_);
  EXPECT_LE(robust_cost(workspace_.current, 5.0, before.sigma_grey), cost_before_at_final_scale);
}

TEST_F(PhotometricAlignment, RecoversGainAndOffsetIfTold) {
  const Brightness darker{0.75, 12.0};
  const GreyImage image = room_.image(T_true_.inverse(), darker);
  const Alignment start = from(exp_se3(0.005 * Vector6d::Ones()) * T_true_);
  const Alignment at = aligned(image, start, {.affine_brightness = true});
  EXPECT_TRUE(at.converged);
  EXPECT_NEAR(at.brightness.gain, 0.75, 0.005);
  EXPECT_NEAR(at.brightness.offset, 12.0, 0.7);
  EXPECT_LT(shift_between(at.T_camera_keyframe, T_true_), 1e-3);
  EXPECT_EQ(aligned(image, start).brightness.gain, 1.0) << "not told";
}

// Brightness that has to be estimated leaves less to know the pose by.
TEST_F(PhotometricAlignment, KnowsLessOfThePoseIfBrightnessIsUnknown) {
  const auto in_residuals = [](const Alignment& at) -> Matrix6d {
    return at.sigma_grey * at.sigma_grey * at.information;
  };
  const AlignmentConfig only_look{.max_iterations = 0};
  const Matrix6d known = in_residuals(aligned(image_, from(T_true_), {}, only_look));
  const Matrix6d unknown =
      in_residuals(aligned(image_, from(T_true_), {.affine_brightness = true}, only_look));
  const Eigen::SelfAdjointEigenSolver<Matrix6d> less(0.5 * (known + known.transpose()) -
                                                     0.5 * (unknown + unknown.transpose()));
  EXPECT_GT(less.eigenvalues().minCoeff(), -1e-6 * less.eigenvalues().maxCoeff());
  EXPECT_GT(less.eigenvalues().maxCoeff(), 0.0);
}

TEST_F(PhotometricAlignment, TellsTheInformationOfWhereItEnded) {
  const Alignment start = from(exp_se3(0.02 * Vector6d::Ones()) * T_true_);
  const Alignment at = aligned(image_, start, {}, {.max_iterations = 1});
  ASSERT_LT(at.cost, 0.5 * aligned(image_, start, {}, {.max_iterations = 0}).cost);
  const Matrix6d there = aligned(image_, at, {}, {.max_iterations = 0}).information;
  EXPECT_LT((at.information - there).norm(), 5e-3 * there.norm());
}

TEST_F(PhotometricAlignment, EndsAtTheSamePlaceIfItDoesNotTellItsInformation) {
  Alignment start = from(exp_se3(0.01 * Vector6d::Ones()) * T_true_);
  const Alignment told = aligned(image_, start);
  start.information = told.information;  // of another pose
  const Alignment at = aligned(image_, start, {}, {}, Information::kLeftOut);
  EXPECT_EQ(at.T_camera_keyframe.matrix(), told.T_camera_keyframe.matrix());
  EXPECT_EQ(at.cost, told.cost);
  EXPECT_EQ(at.information, Matrix6d::Zero());
}

// Pixels whose grey has nothing to do with the scene: a car passed through a tenth of them.
TEST_F(PhotometricAlignment, IsLittleMovedByOutliers) {
  GreyImage image = image_;
  for (int v = 40; v < 80; ++v) {
    for (int u = 60; u < 100; ++u) image.pixels[static_cast<std::size_t>(v * 160 + u)] = 20;
  }
  const Alignment at = aligned(image, from(exp_se3(0.005 * Vector6d::Ones()) * T_true_));
  EXPECT_LT(turn_between(at.T_camera_keyframe, T_true_), 1.5e-3);
  EXPECT_LT(shift_between(at.T_camera_keyframe, T_true_), 1e-2);
}

TEST_F(PhotometricAlignment, HasNothingToSayWhereNothingIsSeen) {
  const Alignment at = aligned(image_, from(pose(0.0, 3.0, 0.0, 0.0, 0.0, 0.0)));
  EXPECT_EQ(at.visible_share, 0.0);
  EXPECT_EQ(at.information, Matrix6d::Zero());
  EXPECT_TRUE(at.T_camera_keyframe.matrix().allFinite());
}

// Scatter over 80 noisy images, in units of what the information says: 1 is honest.
TEST_F(PhotometricAlignment, SaysHowFarItMayBeOff) {
  constexpr int kDraws = 80;
  Matrix6d scatter = Matrix6d::Zero();
  Matrix6d information = Matrix6d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const GreyImage noisy =
        room_.image(T_true_.inverse(), {}, 4.0, 100U + static_cast<unsigned>(i));
    const Alignment at = aligned(noisy, from(T_true_), {}, {.convergence_px = 1e-4});
    const Vector6d error = log_se3(at.T_camera_keyframe * T_true_.inverse());
    scatter += error * error.transpose() / kDraws;
    information += at.information / kDraws;
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(0.5 *
                                                      (information + information.transpose()));
  ASSERT_GT(eigen.eigenvalues().minCoeff(), 0.0);
  const Matrix6d whitened = eigen.operatorSqrt() * scatter * eigen.operatorSqrt();
  const Vector6d ratio = Eigen::SelfAdjointEigenSolver<Matrix6d>(whitened).eigenvalues();
  EXPECT_GT(ratio.minCoeff(), 0.3) << ratio.transpose();
  EXPECT_LT(ratio.maxCoeff(), 3.0) << ratio.transpose();
}

}  // namespace
}  // namespace sparsight
