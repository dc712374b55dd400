#include "tools/evaluation/rotation_angle.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/tools/evaluation/paths.h"

namespace sparsight {
namespace {

TEST(RotationAngle, IsExactFromNanoradiansToHalfATurn) {
  for (const double angle : {0.0, 1e-9, 1e-4, 0.5, 2.0, std::numbers::pi - 1e-9}) {
    const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 3).normalized();
    const Eigen::Isometry3d T = testing::pose(angle * axis, Eigen::Vector3d::Zero());
    EXPECT_NEAR(rotation_angle_rad(T.linear()), angle, 1e-15 + 1e-9 * angle);
  }
}

}  // namespace
}  // namespace sparsight
