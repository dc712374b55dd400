#include "slam/points/point_selection.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "slam/points/visibility.h"
#include "tests/slam/analytic_image.h"
#include "tests/slam/random_values.h"

namespace sparsight {
namespace {

const CameraIntrinsics kIntrinsics{320, 240, 200.0, 200.0, 160.0, 120.0};

CameraReturn seen_at(double u, double v, double depth) {
  const Eigen::Vector3d p = depth * CameraModel(kIntrinsics).unproject({u, v});
  return {.p_camera = p.cast<float>(), .pixel = Eigen::Vector2d(u, v).cast<float>()};
}

GreyImage flat() {
  return analytic_image(320, 240, [](double, double) { return 100.0; });
}

std::vector<SelectedPoint> select(const std::vector<CameraReturn>& returns, const GreyImage& image,
                                  const PointSelectionConfig& config = {}) {
  const CameraModel camera(kIntrinsics);
  return select_points(returns, hidden_from_camera(returns, camera), image, camera, config);
}

std::pair<int, int> bin_of(const Eigen::Vector3f& p, double bin_deg) {
  const Eigen::Vector3d d = p.cast<double>().normalized();
  const double degree = 180.0 / M_PI;
  return {static_cast<int>(std::floor((90.0 + degree * std::asin(d.y())) / bin_deg)),
          static_cast<int>(std::floor((90.0 + degree * std::atan2(d.x(), d.z())) / bin_deg))};
}

// A wall at 10 m, every few pixels.
std::vector<CameraReturn> wall(double step_px) {
  std::vector<CameraReturn> returns;
  for (double v = 0.25; v < 239.0; v += step_px) {
    for (double u = 0.25; u < 319.0; u += step_px) returns.push_back(seen_at(u, v, 10.0));
  }
  return returns;
}

TEST(PointSelection, TakesOnePointOfEveryBinThatHasAny) {
  const GreyImage image = analytic_image(
      320, 240, [](double u, double v) { return 128.0 + 90.0 * std::sin(0.3 * u * v / 50.0); });
  for (const double bin_deg : {1.0, 2.0, 5.0}) {
    std::set<std::pair<int, int>> occupied;
    for (const CameraReturn& r : wall(1.7)) {
      if (CameraModel(kIntrinsics).contains(r.pixel.cast<double>(), 4.0)) {
        occupied.insert(bin_of(r.p_camera, bin_deg));
      }
    }
    std::set<std::pair<int, int>> taken;
    const auto points = select(wall(1.7), image, {.bin_deg = bin_deg});
    for (const SelectedPoint& point : points) taken.insert(bin_of(point.p_camera, bin_deg));
    EXPECT_EQ(points.size(), taken.size());
    EXPECT_EQ(taken, occupied);
  }
}

TEST(PointSelection, TakesTheLargestGradientOfABin) {
  GreyImage image = flat();
  image.pixels[121UL * 320UL + 163UL] = 140;
  image.pixels[121UL * 320UL + 161UL] = 70;  // between them, at 162, the largest change
  const auto points = select(
      {seen_at(161, 120, 8), seen_at(163, 122, 8), seen_at(162, 121, 8), seen_at(165, 124, 8)},
      image);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].pixel, Eigen::Vector2f(162, 121));
}

TEST(PointSelection, TakesAPointWithoutAnyGradientWhereThereIsNoBetter) {
  const auto points = select({seen_at(50, 50, 8), seen_at(200, 150, 8)}, flat());
  EXPECT_EQ(points.size(), 2U);
}

TEST(PointSelection, KeepsPatchesInsideTheImage) {
  for (const SelectedPoint& point : select(wall(1.0), flat(), {.bin_deg = 0.2})) {
    EXPECT_GE(point.pixel.minCoeff(), 4.0F);
    EXPECT_LE(point.pixel.x(), 315.0F);
    EXPECT_LE(point.pixel.y(), 235.0F);
  }
}

TEST(PointSelection, KeepsToItsDepths) {
  const std::vector<CameraReturn> returns{seen_at(40, 50, 0.2), seen_at(80, 50, 0.31),
                                          seen_at(200, 150, 119.0), seen_at(280, 50, 121.0)};
  const auto points = select(returns, flat());
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].pixel.x(), 80.0F);
  EXPECT_EQ(points[1].pixel.x(), 200.0F);
  EXPECT_EQ(select(returns, flat(), {.min_depth_m = 0.1, .max_depth_m = 200.0}).size(), 4U);
}

TEST(PointSelection, LeavesOutEdgesAndHiddenPointsUnlessTold) {
  // One ring, 0.57 degrees apart: a post before a wall.
  std::vector<CameraReturn> returns;
  for (int u = 100; u < 200; u += 2) returns.push_back(seen_at(u, 120, u < 150 ? 4.0 : 12.0));
  const auto pixels = [&](const PointSelectionConfig& config) {
    std::set<int> result;
    for (const SelectedPoint& p : select(returns, flat(), config)) {
      result.insert(static_cast<int>(p.pixel.x()));
    }
    return result;
  };
  const PointSelectionConfig fine{.bin_deg = 0.1};
  PointSelectionConfig edges_only = fine;
  edges_only.reject_hidden = false;
  PointSelectionConfig neither = edges_only;
  neither.reject_depth_edges = false;
  EXPECT_FALSE(pixels(edges_only).contains(148));
  EXPECT_FALSE(pixels(edges_only).contains(150));
  EXPECT_TRUE(pixels(edges_only).contains(152));
  EXPECT_TRUE(pixels(neither).contains(148));
  EXPECT_TRUE(pixels(neither).contains(150));
  PointSelectionConfig hidden_only = fine;
  hidden_only.reject_depth_edges = false;
  EXPECT_TRUE(pixels(hidden_only).contains(148));
  EXPECT_FALSE(pixels(hidden_only).contains(150)) << "in the cell beside the post's";
  EXPECT_TRUE(pixels(hidden_only).contains(160));
}

TEST(PointSelection, MeasuresTheSurfaceOnlyWhenTold) {
  // A floor: inverse depth grows downwards.
  std::vector<CameraReturn> returns;
  for (int v = 150; v < 230; v += 1) {
    for (int u = 20; u < 300; u += 1) returns.push_back(seen_at(u, v, 1.5 * 200.0 / (v - 120.0)));
  }
  const PointSelectionConfig plain{.reject_depth_edges = false, .reject_hidden = false};
  PointSelectionConfig sloped = plain;
  sloped.surface_slope = true;
  for (const SelectedPoint& p : select(returns, flat(), plain)) {
    ASSERT_EQ(p.inverse_depth_slope, Eigen::Vector2f::Zero());
  }
  const auto points = select(returns, flat(), sloped);
  ASSERT_FALSE(points.empty());
  for (const SelectedPoint& p : points) {
    ASSERT_NEAR(p.inverse_depth_slope.x(), 0.0F, 0.15F / 300.0F);
    ASSERT_NEAR(p.inverse_depth_slope.y(), 1.0F / 300.0F, 0.25F / 300.0F);
  }
}

TEST(PointSelection, GivesTheSamePointsEveryTime) {
  const GreyImage image = analytic_image(
      320, 240, [](double u, double v) { return 128.0 + 90.0 * std::sin(0.2 * u + 0.1 * v); });
  const auto first = select(wall(1.3), image);
  const auto second = select(wall(1.3), image);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].p_camera, second[i].p_camera);
    ASSERT_EQ(first[i].pixel, second[i].pixel);
  }
}

TEST(PointSelection, OfNothingIsNothing) { EXPECT_TRUE(select({}, flat()).empty()); }

}  // namespace
}  // namespace sparsight
