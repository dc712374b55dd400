#include "slam/points/surface_slope.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/slam/random_values.h"

namespace sparsight {
namespace {

const CameraIntrinsics kSquareIntrinsics{640, 480, 600.0, 600.0, 320.0, 240.0};

CameraReturn on_plane(const Eigen::Vector3d& normal, double distance, double u, double v) {
  const Eigen::Vector3d ray = CameraModel(kSquareIntrinsics).unproject({u, v});
  return {.p_camera = (distance / normal.dot(ray) * ray).cast<float>(),
          .pixel = Eigen::Vector2d(u, v).cast<float>()};
}

std::vector<CameraReturn> grid_on_plane(const Eigen::Vector3d& normal, double distance,
                                        double step_u, double step_v) {
  std::vector<CameraReturn> returns;
  for (double v = 200.0; v <= 240.0; v += step_v) {
    for (double u = 300.0; u <= 340.0; u += step_u) {
      returns.push_back(on_plane(normal, distance, u, v));
    }
  }
  return returns;
}

// On n . p = d inverse depth is n . ray / d: its slope is (n_x / f_x, n_y / f_y) / d everywhere.
// The fit is held towards zero by as much as four returns one pixel away: half a per cent of these.
RC_GTEST_PROP(SurfaceSlope, IsThatOfAPlane, ()) {
  const Eigen::Vector3d normal =
      Eigen::Vector3d(any_between(-1.5, 1.5), any_between(-1.5, 1.5), 1.0).normalized();
  const double distance = any_between(1.0, 40.0);
  const auto returns = grid_on_plane(normal, distance, 2.0, 2.0);
  const Eigen::Vector2d expected =
      Eigen::Vector2d(normal.x() / kSquareIntrinsics.fx, normal.y() / kSquareIntrinsics.fy) /
      distance;
  const Eigen::Vector2f slope =
      SurfaceSlopes(returns, CameraModel(kSquareIntrinsics)).at(returns.size() / 2);
  RC_ASSERT((slope.cast<double>() - expected).norm() < 0.01 * expected.norm() + 1e-8);
}

TEST(SurfaceSlope, IsZeroAcrossARingWithoutNeighbours) {
  const Eigen::Vector3d normal = Eigen::Vector3d(0.6, 0.7, 1.0).normalized();
  const auto returns = grid_on_plane(normal, 8.0, 2.0, 1000.0);
  const Eigen::Vector2f slope =
      SurfaceSlopes(returns, CameraModel(kSquareIntrinsics)).at(returns.size() / 2);
  EXPECT_NEAR(slope.x(), normal.x() / kSquareIntrinsics.fx / 8.0, 0.02 * normal.x() / 600.0 / 8.0);
  EXPECT_EQ(slope.y(), 0.0F);
}

TEST(SurfaceSlope, OfALoneReturnIsZero) {
  const std::vector<CameraReturn> lone{on_plane(Eigen::Vector3d::UnitZ(), 5.0, 100.0, 100.0)};
  EXPECT_EQ(SurfaceSlopes(lone, CameraModel(kSquareIntrinsics)).at(0), Eigen::Vector2f::Zero());
}

TEST(SurfaceSlope, DoesNotMixAWallWithWhatStandsBehindIt) {
  const Eigen::Vector3d normal = Eigen::Vector3d(0.4, -0.2, 1.0).normalized();
  auto returns = grid_on_plane(normal, 6.0, 2.0, 2.0);
  const std::size_t middle = returns.size() / 2;
  const SurfaceSlopes alone(returns, CameraModel(kSquareIntrinsics));
  const Eigen::Vector2f expected = alone.at(middle);
  auto mixed = returns;
  for (double v = 201.0; v <= 240.0; v += 2.0) {
    for (double u = 301.0; u <= 340.0; u += 2.0) {
      mixed.push_back(on_plane(Eigen::Vector3d::UnitZ(), 14.0, u, v));
    }
  }
  EXPECT_EQ(SurfaceSlopes(mixed, CameraModel(kSquareIntrinsics)).at(middle), expected);
}

// A few returns from a twig 5 % nearer, within what counts as the same surface.
TEST(SurfaceSlope, IsLittleMovedByAFewOtherReturns) {
  const Eigen::Vector3d normal = Eigen::Vector3d(0.4, -0.2, 1.0).normalized();
  auto returns = grid_on_plane(normal, 6.0, 2.0, 2.0);
  const std::size_t middle = returns.size() / 2;
  const Eigen::Vector2f expected =
      SurfaceSlopes(returns, CameraModel(kSquareIntrinsics)).at(middle);
  auto disturbed = returns;
  for (int i = 0; i < 8; ++i) {
    CameraReturn twig = on_plane(normal, 5.7, 323.0 + 0.7 * i, 220.0);
    disturbed.push_back(twig);
  }
  const Eigen::Vector2f slope = SurfaceSlopes(disturbed, CameraModel(kSquareIntrinsics)).at(middle);
  EXPECT_LT((slope - expected).norm(), 0.25F * expected.norm());
}

TEST(SurfaceSlope, CanBeAskedForInEveryCornerOfTheImage) {
  std::vector<CameraReturn> returns;
  for (const double u : {0.0, 639.0}) {
    for (const double v : {0.0, 479.0}) {
      returns.push_back(on_plane(Eigen::Vector3d::UnitZ(), 5.0, u, v));
    }
  }
  const SurfaceSlopes slopes(returns, CameraModel(kSquareIntrinsics));
  for (std::size_t i = 0; i < returns.size(); ++i) {
    EXPECT_EQ(slopes.at(i), Eigen::Vector2f::Zero());
  }
}

}  // namespace
}  // namespace sparsight
