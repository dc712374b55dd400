#include "tests/synthetic/lens.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace sparsight::synthetic {
namespace {

const CameraIntrinsics kRectified{640, 480, 525.0, 500.0, 319.5, 239.5};
const CameraIntrinsics kDistorted{640,   480,  525.0,  500.0,   319.5, 239.5,
                                  -0.28, 0.07, 0.0012, -0.0008, 0.0};

TEST(Lens, PrincipalPointLooksStraightAhead) {
  EXPECT_TRUE(pixel_direction(kRectified, {319.5, 239.5}).isApprox(Eigen::Vector3d::UnitZ()));
}

TEST(Lens, OneFocalLengthToTheRightIsFortyFiveDegrees) {
  const Eigen::Vector3d direction = pixel_direction(kRectified, {319.5 + 525.0, 239.5});
  EXPECT_TRUE(direction.isApprox(Eigen::Vector3d(1.0, 0.0, 1.0).normalized()));
}

TEST(Lens, DistortionFollowsBrownConradyByHand) {
  // x = 0.5, y = 0.25: r2 = 0.3125, radial = 1 - 0.28 r2 + 0.07 r2^2 = 0.9193359375.
  const auto pixel = project(kDistorted, {0.5, 0.25, 1.0});
  const double x = 0.5 * 0.9193359375 + 2 * 0.0012 * 0.125 - 0.0008 * (0.3125 + 0.5);
  const double y = 0.25 * 0.9193359375 + 0.0012 * (0.3125 + 0.125) - 2 * 0.0008 * 0.125;
  EXPECT_NEAR(pixel->x(), 319.5 + 525.0 * x, 1e-9);
  EXPECT_NEAR(pixel->y(), 239.5 + 500.0 * y, 1e-9);
}

TEST(Lens, PointsBehindTheCameraHaveNoPixel) {
  EXPECT_FALSE(project(kRectified, {0.1, 0.1, -1.0}));
}

RC_GTEST_PROP(Lens, ProjectionUndoesThePixelsDirection, ()) {
  const auto tenth_u = *rc::gen::inRange(0, 6390);
  const auto tenth_v = *rc::gen::inRange(0, 4790);
  const Eigen::Vector2d pixel(tenth_u / 10.0, tenth_v / 10.0);
  const bool distorted = *rc::gen::arbitrary<bool>();
  const CameraIntrinsics& camera = distorted ? kDistorted : kRectified;
  const auto back = project(camera, 7.0 * pixel_direction(camera, pixel));
  RC_ASSERT(back.has_value());
  RC_ASSERT((*back - pixel).norm() < 1e-6);
}

}  // namespace
}  // namespace sparsight::synthetic
