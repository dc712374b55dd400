#include "slam/window/marginalization.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "tests/slam/random_values.h"

namespace sparsight {
namespace {

// Positive definite, every keyframe tied to every other.
Quadratic any_energy(int keyframes) {
  Quadratic energy(keyframes);
  const Eigen::Index n = energy.b.size();
  Eigen::MatrixXd A(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) A(i, j) = any_between(-1.0, 1.0);
    energy.b(i) = any_between(-5.0, 5.0);
  }
  energy.H = A.transpose() * A + 0.5 * Eigen::MatrixXd::Identity(n, n);
  return energy;
}

double value(const Quadratic& energy, const Eigen::VectorXd& d) {
  return d.dot(0.5 * energy.H * d + energy.b);
}

Eigen::VectorXd minimum(const Quadratic& energy) { return energy.H.llt().solve(-energy.b); }

RC_GTEST_PROP(Marginalization, LeavesTheSolutionOfTheOthersAsItWas, ()) {
  const int keyframes = *rc::gen::inRange(2, 6);
  const Quadratic energy = any_energy(keyframes);
  const Quadratic reduced = without_first(energy);
  RC_ASSERT(reduced.b.size() == energy.b.size() - 6);
  const Eigen::VectorXd expected = minimum(energy).tail(reduced.b.size());
  RC_ASSERT((minimum(reduced) - expected).norm() < 1e-8 * (1.0 + expected.norm()));
}

// The reduced energy is that of the best first keyframe for each choice of the others.
RC_GTEST_PROP(Marginalization, KeepsTheEnergyUpToAConstant, ()) {
  const Quadratic energy = any_energy(3);
  const Quadratic reduced = without_first(energy);
  const auto best_of_first = [&](const Eigen::VectorXd& others) {
    Eigen::VectorXd d(18);
    const Eigen::VectorXd slope = energy.b.head<6>() + energy.H.topRightCorner(6, 12) * others;
    d << energy.H.topLeftCorner<6, 6>().llt().solve(-slope), others;
    return value(energy, d);
  };
  Eigen::VectorXd others(12);
  for (Eigen::Index i = 0; i < 12; ++i) others(i) = any_between(-2.0, 2.0);
  const double expected = best_of_first(others) - best_of_first(Eigen::VectorXd::Zero(12));
  RC_ASSERT(std::abs(value(reduced, others) - expected) < 1e-7 * (1.0 + std::abs(expected)));
}

RC_GTEST_PROP(Marginalization, StaysSymmetricAndPositive, ()) {
  const Quadratic reduced = without_first(any_energy(*rc::gen::inRange(2, 6)));
  RC_ASSERT(reduced.H == reduced.H.transpose());
  RC_ASSERT(reduced.H.llt().info() == Eigen::Success);
}

TEST(Marginalization, OfAKeyframeThatNothingConstrainsChangesNothing) {
  Quadratic energy(2);
  energy.H.bottomRightCorner<6, 6>() = 3.0 * Matrix6d::Identity();
  energy.b.tail<6>() = Vector6d::LinSpaced(6, 1.0, 2.0);
  const Quadratic reduced = without_first(energy);
  EXPECT_EQ(reduced.H, 3.0 * Matrix6d::Identity());
  EXPECT_EQ(reduced.b, energy.b.tail<6>());
}

// One spring between the second rows of both keyframes; the first is otherwise free: once it may go
// where it likes, the spring holds nothing.
TEST(Marginalization, DropsWhatOnlyTheLeaverHeld) {
  Quadratic energy(2);
  energy.H(1, 1) = energy.H(7, 7) = 4.0;
  energy.H(1, 7) = energy.H(7, 1) = -4.0;
  energy.b(1) = 2.0;
  energy.b(7) = -2.0;
  EXPECT_LT(without_first(energy).H.norm(), 1e-12);
  EXPECT_LT(without_first(energy).b.norm(), 1e-12);
  // Held by a second spring of the same strength, half of it arrives.
  energy.H(1, 1) = 8.0;
  EXPECT_NEAR(without_first(energy).H(1, 1), 2.0, 1e-12);
  EXPECT_NEAR(without_first(energy).b(1), -1.0, 1e-12);
}

// Weak directions of a well-known keyframe are still directions.
TEST(Marginalization, KeepsDirectionsKnownAMillionTimesLessThanOthers) {
  Quadratic energy(2);
  for (int i = 0; i < 6; ++i) {
    const double strength = i == 3 ? 1.0 : 1e6;
    energy.H(i, i) = 2.0 * strength;
    energy.H(6 + i, 6 + i) = strength;
    energy.H(i, 6 + i) = energy.H(6 + i, i) = -strength;
  }
  const Quadratic reduced = without_first(energy);
  EXPECT_NEAR(reduced.H(3, 3), 0.5, 1e-6);
  EXPECT_NEAR(reduced.H(0, 0), 0.5e6, 1.0);
}

RC_GTEST_PROP(InformationOfSecond, IsTheInverseOfItsCovarianceWithTheFirstHeld, ()) {
  const int keyframes = *rc::gen::inRange(2, 6);
  const Quadratic energy = any_energy(keyframes);
  const Eigen::Index free = energy.b.size() - 6;
  const Eigen::MatrixXd covariance = energy.H.bottomRightCorner(free, free).inverse();
  const Matrix6d expected = covariance.topLeftCorner<6, 6>().inverse();
  RC_ASSERT((information_of_second(energy) - expected).norm() < 1e-7 * expected.norm());
}

}  // namespace
}  // namespace sparsight
