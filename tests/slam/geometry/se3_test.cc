#include "slam/geometry/se3.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "tests/numeric_jacobian.h"
#include "tests/slam/random_values.h"

namespace sparsight {
namespace {

double distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return (a.matrix() - b.matrix()).norm();
}

TEST(Se3, QuarterTurnAlongACircleComputedByHand) {
  // Driving 1 m per radian * pi/2 while turning left by a quarter: a circle of radius 2/pi.
  Vector6d xi;
  xi << 0.0, 0.0, M_PI_2, 1.0, 0.0, 0.0;
  const Eigen::Isometry3d T = exp_se3(xi);
  EXPECT_LT((T.translation() - Eigen::Vector3d(M_2_PI, M_2_PI, 0.0)).norm(), 1e-15);
  EXPECT_LT((T.linear() * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-15);
}

TEST(Se3, HatIsTheCrossProduct) {
  const Eigen::Vector3d a(1.0, -2.0, 3.0);
  const Eigen::Vector3d b(0.5, 4.0, -1.0);
  EXPECT_EQ(hat(a) * b, a.cross(b));
}

RC_GTEST_PROP(Se3, MotionsAlongOneTwistAdd, ()) {
  const Vector6d xi = any_increment(2.0, 5.0);
  const double s = any_between(-3.0, 3.0);
  const double t = any_between(-3.0, 3.0);
  RC_ASSERT(distance(exp_se3(s * xi) * exp_se3(t * xi), exp_se3((s + t) * xi)) < 1e-11);
}

RC_GTEST_PROP(Se3, TheNegativeIncrementIsTheInverse, ()) {
  const Vector6d xi = any_increment(10.0, 5.0);
  RC_ASSERT(distance(exp_se3(xi) * exp_se3(-xi), Eigen::Isometry3d::Identity()) < 1e-12);
}

RC_GTEST_PROP(Se3, LogInvertsExp, ()) {
  const Vector6d xi = any_increment(3.1, 10.0);
  RC_ASSERT((log_se3(exp_se3(xi)) - xi).norm() < 1e-11);
}

// Close to zero the closed forms divide zero by zero; the branch must not be seen.
RC_GTEST_PROP(Se3, LogInvertsExpForTheSmallestTurns, ()) {
  const double angle = std::pow(10.0, any_between(-15.0, -2.0));
  Vector6d xi;
  xi << angle * any_direction(), any_vector(10.0);
  const Vector6d back = log_se3(exp_se3(xi));
  RC_ASSERT((back.head<3>() - xi.head<3>()).norm() < 1e-15 + 1e-13 * angle);
  RC_ASSERT((back.tail<3>() - xi.tail<3>()).norm() < 1e-13 * 10.0);
}

RC_GTEST_PROP(Se3, LogInvertsExpJustBelowHalfATurn, ()) {
  Vector6d xi;
  xi << (M_PI - std::pow(10.0, any_between(-7.0, -1.0))) * any_direction(), any_vector(10.0);
  RC_ASSERT((log_se3(exp_se3(xi)) - xi).norm() < 1e-10);
}

TEST(Se3, LogOfHalfATurnIsAHalfTurn) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Vector3d(-1.0, 1.0, -1.0).asDiagonal();
  T.translation() = Eigen::Vector3d(1.0, 2.0, 3.0);
  const Vector6d xi = log_se3(T);
  EXPECT_NEAR(xi.head<3>().norm(), M_PI, 1e-15);
  EXPECT_LT(distance(exp_se3(xi), T), 1e-14);
}

RC_GTEST_PROP(Se3, AdjointCarriesAnIncrementToTheOtherSide, ()) {
  const Eigen::Isometry3d T = any_pose();
  const Vector6d xi = any_increment(2.0, 5.0);
  RC_ASSERT(distance(T * exp_se3(xi), exp_se3(adjoint(T) * xi) * T) < 1e-10);
}

RC_GTEST_PROP(Se3, AdjointIsAHomomorphism, ()) {
  const Eigen::Isometry3d A = any_pose();
  const Eigen::Isometry3d B = any_pose();
  RC_ASSERT((adjoint(A * B) - adjoint(A) * adjoint(B)).norm() < 1e-11);
  RC_ASSERT((adjoint(A.inverse()) * adjoint(A) - Matrix6d::Identity()).norm() < 1e-11);
}

// The derivative that all photometric Jacobians build on: d (exp(xi) p) / d xi = [-hat(p), I].
RC_GTEST_PROP(Se3, LeftIncrementMovesAPointAsItsDerivativeSays, ()) {
  const Eigen::Vector3d p = any_vector(20.0);
  const auto moved = [&](const Eigen::VectorXd& xi) -> Eigen::VectorXd {
    return exp_se3(Vector6d(xi)) * p;
  };
  Eigen::Matrix<double, 3, 6> J;
  J << -hat(p), Eigen::Matrix3d::Identity();
  RC_ASSERT((numeric_jacobian(moved, 6, 1e-5) - J).norm() < 1e-7);
}

RC_GTEST_PROP(Se3, RenormalizedTakesRoundingOutAndNothingElse, ()) {
  const Eigen::Isometry3d T = any_pose();
  RC_ASSERT(distance(renormalized(T), T) < 1e-14);
  Eigen::Isometry3d worn = T;
  worn.linear() += 1e-6 * hat(any_vector(1.0)) * hat(any_vector(1.0));
  const Eigen::Isometry3d repaired = renormalized(worn);
  RC_ASSERT(
      (repaired.linear() * repaired.linear().transpose() - Eigen::Matrix3d::Identity()).norm() <
      1e-14);
  RC_ASSERT(distance(repaired, T) < 1e-5);
  RC_ASSERT(repaired.translation() == T.translation());
}

}  // namespace
}  // namespace sparsight
