#include "slam/points/visibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sparsight {
namespace {

const CameraIntrinsics kKittiIntrinsics{1226, 370, 707.0, 707.0, 601.0, 183.0};
constexpr double kDegree = M_PI / 180.0;

CameraReturn seen(const Eigen::Vector3d& p, int ring) {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  EXPECT_TRUE(CameraModel(kKittiIntrinsics).project(p, pixel));
  return {.p_camera = p.cast<float>(),
          .pixel = pixel.cast<float>(),
          .ring = static_cast<std::uint16_t>(ring)};
}

Eigen::Vector3d ray(double azimuth_deg, double down_deg) {
  const double a = azimuth_deg * kDegree;
  const double e = down_deg * kDegree;
  return {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
}

// One ring along the horizon past whatever range_at says.
template <typename Range>
std::vector<CameraReturn> ring_past(const Range& range_at, double step_deg) {
  std::vector<CameraReturn> returns;
  for (double azimuth = -30.0; azimuth < 30.0; azimuth += step_deg) {
    returns.push_back(seen(range_at(azimuth) * ray(azimuth, 0.0), 7));
  }
  return returns;
}

std::size_t marked(const std::vector<bool>& flags) {
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), true));
}

TEST(DepthEdge, IsMarkedOnBothSidesOfAJumpAndNowhereElse) {
  const auto post = [](double azimuth) { return std::abs(azimuth) < 2.05 ? 5.0 : 12.0; };
  const auto returns = ring_past(post, 0.2);
  const std::vector<bool> edge = on_depth_edge(returns);
  EXPECT_EQ(marked(edge), 4U);
  for (std::size_t i = 0; i + 1 < returns.size(); ++i) {
    const float here = returns[i].p_camera.norm();
    const float next = returns[i + 1].p_camera.norm();
    if (std::abs(here - next) > 1.0F) {
      EXPECT_TRUE(edge[i] && edge[i + 1]);
    }
  }
}

TEST(DepthEdge, IsNotAWallSeenAtSixDegrees) {
  // Distance 2 m to the side: range 2 / sin(azimuth).
  std::vector<CameraReturn> returns;
  for (double azimuth = 6.0; azimuth < 30.0; azimuth += 0.2) {
    returns.push_back(seen(2.0 / std::sin(azimuth * kDegree) * ray(azimuth, 0.0), 3));
  }
  EXPECT_EQ(marked(on_depth_edge(returns)), 0U);
}

TEST(DepthEdge, IsNotTheNoiseOfTheSensor) {
  const auto returns =
      ring_past([](double azimuth) { return 0.5 + 0.04 * std::sin(1e4 * azimuth); }, 0.2);
  EXPECT_EQ(marked(on_depth_edge(returns)), 0U);
}

TEST(DepthEdge, JoinsNeitherRingsNorFiringsWithAGapBetween) {
  std::vector<CameraReturn> returns{seen(5.0 * ray(0.0, 0.0), 1), seen(9.0 * ray(0.1, 0.4), 2)};
  EXPECT_EQ(marked(on_depth_edge(returns)), 0U) << "another ring";
  returns = {seen(5.0 * ray(0.0, 0.0), 1), seen(9.0 * ray(1.5, 0.0), 1)};
  EXPECT_EQ(marked(on_depth_edge(returns)), 0U) << "a gap of 1.5 degrees";
  returns = {seen(5.0 * ray(0.0, 0.0), 1), seen(9.0 * ray(0.5, 0.0), 1)};
  EXPECT_EQ(marked(on_depth_edge(returns)), 2U);
  EXPECT_TRUE(on_depth_edge({}).empty());
}

TEST(Hidden, IsWhatANearerSurfaceCovers) {
  std::vector<CameraReturn> returns;
  for (double down = -3.0; down <= 3.0; down += 0.4) {
    for (double azimuth = -3.0; azimuth <= 3.0; azimuth += 0.2) {
      returns.push_back(seen(5.0 * ray(azimuth, down), 1));
    }
  }
  const std::size_t box = returns.size();
  returns.push_back(seen(20.0 * ray(0.07, 0.1), 2));  // behind the box
  returns.push_back(seen(20.0 * ray(2.9, -2.0), 2));  // just behind its edge
  returns.push_back(seen(20.0 * ray(5.0, 0.0), 2));   // clear of it by more than two cells
  returns.push_back(seen(5.3 * ray(0.07, 0.1), 2));   // on it, within noise and slope
  returns.push_back(seen(2.0 * ray(0.07, 0.1), 2));   // in front
  const std::vector<bool> hidden = hidden_from_camera(returns, CameraModel(kKittiIntrinsics));
  EXPECT_TRUE(hidden[box]);
  EXPECT_TRUE(hidden[box + 1]);
  EXPECT_FALSE(hidden[box + 2]);
  EXPECT_FALSE(hidden[box + 4]);
  returns.pop_back();
  const std::vector<bool> without = hidden_from_camera(returns, CameraModel(kKittiIntrinsics));
  EXPECT_FALSE(without[box + 3]);
  for (std::size_t i = 0; i < box; ++i) ASSERT_FALSE(without[i]);
}

TEST(Hidden, TakesPointsAtTheImagesVeryEdge) {
  const CameraModel camera(kKittiIntrinsics);
  std::vector<CameraReturn> returns;
  for (const double u : {0.0, 1225.0}) {
    for (const double v : {0.0, 369.0}) {
      returns.push_back(seen(10.0 * camera.unproject({u, v}), 1));
    }
  }
  EXPECT_EQ(marked(hidden_from_camera(returns, camera)), 0U);
  EXPECT_TRUE(hidden_from_camera({}, camera).empty());
}

// The road from a car, 1.65 m below the camera, as an HDL-64E scans it up to 50 m.
TEST(Visibility, KeepsTheRoad) {
  std::vector<CameraReturn> returns;
  for (int ring = 0; ring < 64; ++ring) {
    const double down = -2.0 + 26.33 * ring / 63.0;
    if (down < 1.65 / 50.0 / kDegree) continue;
    for (double azimuth = -15.0; azimuth < 15.0; azimuth += 0.17) {
      const Eigen::Vector3d direction = ray(azimuth, down);
      const Eigen::Vector3d p = 1.65 / direction.y() * direction;
      Eigen::Vector2d pixel;
      const CameraModel camera(kKittiIntrinsics);
      if (!camera.project(p, pixel) || !camera.contains(pixel, 0.0)) continue;
      returns.push_back(seen(p, ring));
    }
  }
  ASSERT_GT(returns.size(), 3000U);
  EXPECT_EQ(marked(on_depth_edge(returns)), 0U);
  EXPECT_EQ(marked(hidden_from_camera(returns, CameraModel(kKittiIntrinsics))), 0U);
}

}  // namespace
}  // namespace sparsight
