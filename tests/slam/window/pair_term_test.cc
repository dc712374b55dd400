#include "slam/window/pair_term.h"

#include <gtest/gtest.h>

#include "tests/numeric_jacobian.h"
#include "tests/slam/sine_room.h"

namespace sparsight {
namespace {

class PairTermTest : public testing::Test {
 protected:
  PairTerm term_at(const Alignment& at, const PhotometryConfig& photometry = {}) {
    return pair_term(host_, target_, room_.camera(), at, photometry, workspace_);
  }
  Alignment off_by(const Vector6d& xi) const {
    Alignment at;
    at.T_camera_keyframe = exp_se3(xi) * T_target_host_;
    return at;
  }

  const SineRoom room_{};
  const Eigen::Isometry3d T_world_target_ = pose(0.01, -0.06, 0.02, 0.2, 0.1, 0.3);
  const Eigen::Isometry3d T_target_host_ = T_world_target_.inverse();
  const Keyframe host_ = room_.keyframe(0, Eigen::Isometry3d::Identity());
  const Keyframe target_ =
      room_.keyframe(1, T_world_target_, room_.image(T_world_target_, {0.8, 10.0}));
  AlignmentWorkspace workspace_;
};

TEST_F(PairTermTest, EnergyIsThatOfTheLinearisationItLeaves) {
  const PairTerm term = term_at(off_by(0.002 * Vector6d::Ones()));
  EXPECT_GT(term.energy, 0.0);
  EXPECT_NEAR(energy_at(term, workspace_.current, {}), term.energy, 1e-6 * term.energy);
  double pixels = 0.0;
  for (const float weight : workspace_.current.weight) pixels += static_cast<double>(weight);
  EXPECT_NEAR(term.pixels, pixels, 1e-6 * pixels);
}

// The window descends along b: it must be the energy's slope. Pixels that the steps carry over the
// border would change the energy otherwise.
TEST_F(PairTermTest, RightSideIsTheSlopeOfTheEnergy) {
  const Vector6d off = 0.004 * Vector6d::Ones();
  Keyframe host = host_;
  PatchSet& patches = host.patches[0];
  for (std::size_t i = 0; i < patches.entries(); ++i) {
    Eigen::Vector2d pixel;
    const Eigen::Vector3d p(patches.x[i], patches.y[i], patches.z[i]);
    if (!room_.camera().project(T_target_host_ * p, pixel) ||
        !room_.camera().contains(pixel, 6.0)) {
      patches.weight[i] = 0.0F;
    }
  }
  const PairTerm term = pair_term(host, target_, room_.camera(), off_by(off), {}, workspace_);
  const auto energy = [&](const Eigen::VectorXd& xi) -> Eigen::VectorXd {
    Linearization l;
    linearize(patches, target_.pyramid.level(0), room_.camera(),
              exp_se3(Vector6d(xi)) * off_by(off).T_camera_keyframe, {}, l);
    return Eigen::VectorXd::Constant(1, energy_at(term, l, {}));
  };
  const Eigen::VectorXd slope = numeric_jacobian(energy, 6, 6e-3).transpose();
  const Vector6d scale = term.H.diagonal().cwiseSqrt();
  EXPECT_LT(((slope - term.b).array() / scale.array()).matrix().norm(),
            0.1 * (term.b.array() / scale.array()).matrix().norm());
}

TEST_F(PairTermTest, BrightnessIsEliminatedNotFixed) {
  const PhotometryConfig affine{.affine_brightness = true};
  Alignment at = off_by(Vector6d::Zero());
  PairTerm term;
  for (int i = 0; i < 20; ++i) {
    term = term_at(at, affine);
    at.brightness.gain += term.brightness_step.x();
    at.brightness.offset += term.brightness_step.y();
  }
  EXPECT_NEAR(at.brightness.gain, 0.8, 0.005);
  EXPECT_NEAR(at.brightness.offset, 10.0, 0.7);
  EXPECT_LT(term.brightness_step.norm(), 0.01);
  const Matrix6d fixed = term_at(at).H;
  for (int k = 0; k < 6; ++k) EXPECT_LE(term.H(k, k), fixed(k, k) * (1.0 + 1e-6));
}

}  // namespace
}  // namespace sparsight
