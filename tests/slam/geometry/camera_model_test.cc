#include "slam/geometry/camera_model.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "slam/image/pyramid.h"
#include "tests/numeric_jacobian.h"
#include "tests/slam/random_values.h"
#include "tests/synthetic/lens.h"

namespace sparsight {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const CameraIntrinsics kPinhole{640, 480, 500.0, 510.0, 320.0, 240.0};
// A wide-angle lens as one is bought, every coefficient at work.
const CameraIntrinsics kLens{640, 480, 500.0, 510.0, 320.0, 240.0, -0.3, 0.1, 0.001, -0.002, -0.01};

Eigen::Vector2d projected(const CameraModel& camera, const Eigen::Vector3d& p) {
  Eigen::Vector2d pixel(kNan, kNan);
  EXPECT_TRUE(camera.project(p, pixel)) << p.transpose();
  return pixel;
}

TEST(CameraModel, ProjectsAsAPinhole) {
  const Eigen::Vector2d pixel = projected(CameraModel(kPinhole), {1.0, -0.5, 2.0});
  EXPECT_LT((pixel - Eigen::Vector2d(570.0, 112.5)).norm(), 1e-12);
}

// x = 0.3, y = -0.2: r^2 = 0.13, radial factor 0.96266803; the tangential terms add -0.00074 and
// 0.00045. OpenCV's "Camera Calibration and 3D Reconstruction" has the formula.
TEST(CameraModel, DistortsAsComputedByHand) {
  const Eigen::Vector2d pixel = projected(CameraModel(kLens), {0.6, -0.4, 2.0});
  EXPECT_NEAR(pixel.x(), 320.0 + 500.0 * 0.288060409, 1e-6);
  EXPECT_NEAR(pixel.y(), 240.0 - 510.0 * 0.192083606, 1e-6);
}

RC_GTEST_PROP(CameraModel, AgreesWithTheLensWrittenForTheTests, ()) {
  const Eigen::Vector3d p =
      any_between(0.5, 50.0) * Eigen::Vector3d(any_between(-0.6, 0.6), any_between(-0.5, 0.5), 1.0);
  const auto other = synthetic::project(kLens, p);
  RC_ASSERT(other.has_value());
  RC_ASSERT((projected(CameraModel(kLens), p) - *other).norm() < 1e-9);
}

RC_GTEST_PROP(CameraModel, UnprojectInvertsProjectAllOverTheImage, ()) {
  const CameraModel camera(*rc::gen::element(kPinhole, kLens));
  const Eigen::Vector2d pixel(any_between(0.0, 639.0), any_between(0.0, 479.0));
  const Eigen::Vector3d ray = camera.unproject(pixel);
  RC_ASSERT(ray.z() == 1.0);
  RC_ASSERT((projected(camera, any_between(0.1, 100.0) * ray) - pixel).norm() < 1e-8);
}

RC_GTEST_PROP(CameraModel, DerivativeIsThatOfTheProjection, ()) {
  const CameraModel camera(*rc::gen::element(kPinhole, kLens));
  const Eigen::Vector2d at(any_between(-0.6, 0.6), any_between(-0.5, 0.5));
  const auto pixel_at = [&](const Eigen::VectorXd& d) -> Eigen::VectorXd {
    return projected(camera, (at + d.head<2>()).homogeneous());
  };
  RC_ASSERT((numeric_jacobian(pixel_at, 2, 1e-6) - camera.d_pixel_d_normalized(at)).norm() < 1e-5);
}

// With k1 = -0.4 alone, r (1 + k1 r^2) turns back at r^2 = 1 / (3 * 0.4).
TEST(CameraModel, StopsWhereTheDistortionFoldsBack) {
  CameraIntrinsics barrel = kPinhole;
  barrel.k1 = -0.4;
  const CameraModel camera(barrel);
  EXPECT_LE(camera.max_radius2(), 1.0 / 1.2);
  EXPECT_GT(camera.max_radius2(), 1.0 / 1.2 - 0.02);
  Eigen::Vector2d pixel(1.0, 2.0);
  EXPECT_TRUE(camera.project({0.9, 0.0, 1.0}, pixel));
  pixel = {1.0, 2.0};
  EXPECT_FALSE(camera.project({0.92, 0.0, 1.0}, pixel));
  EXPECT_FALSE(camera.project({0.0, -5.0, 1.0}, pixel));
  EXPECT_EQ(pixel, Eigen::Vector2d(1.0, 2.0)) << "no pixel is given";
}

TEST(CameraModel, RefusesWhatIsBehindOrNotANumber) {
  Eigen::Vector2d pixel;
  for (const CameraIntrinsics& intrinsics : {kPinhole, kLens}) {
    const CameraModel camera(intrinsics);
    EXPECT_FALSE(camera.project({0.1, 0.1, -1.0}, pixel));
    EXPECT_FALSE(camera.project({0.1, 0.1, 0.0}, pixel));
    EXPECT_FALSE(camera.project({kNan, 0.1, 1.0}, pixel));
    EXPECT_FALSE(camera.project({0.1, kNan, 1.0}, pixel));
    EXPECT_FALSE(camera.project({0.1, 0.1, kNan}, pixel));
    EXPECT_FALSE(camera.project({1e300, 0.1, 1e-5}, pixel));
  }
}

TEST(CameraModel, ContainsCountsThePixelsCentres) {
  const CameraModel camera(kPinhole);
  EXPECT_TRUE(camera.contains({0.0, 0.0}, 0.0));
  EXPECT_TRUE(camera.contains({639.0, 479.0}, 0.0));
  EXPECT_FALSE(camera.contains({-0.01, 5.0}, 0.0));
  EXPECT_FALSE(camera.contains({5.0, 479.01}, 0.0));
  EXPECT_TRUE(camera.contains({4.0, 475.0}, 4.0));
  EXPECT_FALSE(camera.contains({635.5, 100.0}, 4.0));
  EXPECT_FALSE(camera.contains({kNan, 5.0}, 0.0));
}

// The centre of a pixel made of four lies in the middle of theirs: u_fine = 2 u_coarse + 0.5.
RC_GTEST_PROP(CameraModel, LevelsLookThroughTheMiddleOfTheirPixels, ()) {
  const CameraModel camera(*rc::gen::element(kPinhole, kLens));
  const int level = *rc::gen::inRange(0, 5);
  const CameraModel coarse = camera.at_level(level);
  const Eigen::Vector3d p(any_between(-1.0, 1.0), any_between(-0.8, 0.8), 2.0);
  Eigen::Vector2d expected = projected(camera, p);
  for (int i = 0; i < level; ++i) expected = (expected.array() - 0.5) / 2.0;
  RC_ASSERT((projected(coarse, p) - expected).norm() < 1e-9);
}

TEST(CameraModel, LevelsHaveTheSizeOfThePyramids) {
  const CameraIntrinsics odd{1241, 376, 700.0, 700.0, 600.0, 180.0};
  const ImagePyramid pyramid({1241, 376, std::vector<std::uint8_t>(1241UL * 376UL)}, 5);
  for (int level = 0; level < pyramid.levels(); ++level) {
    const CameraIntrinsics c = CameraModel(odd).at_level(level).intrinsics();
    EXPECT_EQ(c.width, pyramid.level(level).width);
    EXPECT_EQ(c.height, pyramid.level(level).height);
  }
}

}  // namespace
}  // namespace sparsight
