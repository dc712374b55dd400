#include "slam/graph/edge_error.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/numeric_jacobian.h"
#include "tests/slam/random_values.h"

namespace sparsight {
namespace {

RC_GTEST_PROP(EdgeError, HasTheJacobiansOfItsDifferences, ()) {
  const Eigen::Isometry3d T_world_from = any_pose();
  const Eigen::Isometry3d T_from_to = any_pose();
  // The error may be large (a false loop), but not at pi, where the logarithm jumps.
  const Eigen::Isometry3d T_world_to = T_world_from * exp_se3(any_increment(2.5, 3.0)) * T_from_to;
  const auto of_from = [&](const Eigen::VectorXd& eta) -> Eigen::VectorXd {
    return edge_error(T_world_from * exp_se3(eta), T_world_to, T_from_to);
  };
  const auto of_to = [&](const Eigen::VectorXd& eta) -> Eigen::VectorXd {
    return edge_error(T_world_from, T_world_to * exp_se3(eta), T_from_to);
  };
  const EdgeJacobians J =
      edge_jacobians(edge_error(T_world_from, T_world_to, T_from_to), T_from_to);
  RC_ASSERT((J.d_error_d_from - numeric_jacobian(of_from, 6, 1e-6)).cwiseAbs().maxCoeff() < 1e-6);
  RC_ASSERT((J.d_error_d_to - numeric_jacobian(of_to, 6, 1e-6)).cwiseAbs().maxCoeff() < 1e-5);
}

RC_GTEST_PROP(EdgeError, IsTheLeftPerturbationOfTheMeasurement, ()) {
  const Vector6d xi = any_increment(1.0, 1.0);
  const Eigen::Isometry3d T_world_from = any_pose();
  const Eigen::Isometry3d T_from_to = any_pose();
  const Vector6d error =
      edge_error(T_world_from, T_world_from * exp_se3(xi) * T_from_to, T_from_to);
  RC_ASSERT((error - xi).norm() < 1e-9);
}

RC_GTEST_PROP(EdgeError, IsTheSameWhereverTheWorldBegins, ()) {
  const Eigen::Isometry3d T_new_world = any_pose();
  const Eigen::Isometry3d a = any_pose();
  const Eigen::Isometry3d Z = any_pose();
  const Eigen::Isometry3d b = a * Z * exp_se3(any_increment(0.5, 1.0));
  RC_ASSERT((edge_error(a, b, Z) - edge_error(T_new_world * a, T_new_world * b, Z)).norm() < 1e-8);
}

TEST(InverseLeftJacobian, SeriesAndClosedFormMeetWhereOneTakesOver) {
  Vector6d direction;
  direction << 0.6, -0.64, 0.48, 3.0, -2.0, 5.0;
  Vector6d below = direction;
  Vector6d above = direction;
  below.head<3>() *= 0.01 * (1.0 - 1e-9);
  above.head<3>() *= 0.01 * (1.0 + 1e-9);
  EXPECT_LT((inverse_left_jacobian(below) - inverse_left_jacobian(above)).cwiseAbs().maxCoeff(),
            1e-6);
}

}  // namespace
}  // namespace sparsight
