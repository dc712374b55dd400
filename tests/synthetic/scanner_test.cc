#include "tests/synthetic/scanner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/synthetic/lens.h"
#include "tests/synthetic/scene.h"

namespace sparsight::synthetic {
namespace {

constexpr std::size_t kFrame = 12;

Scene noiseless(const char* name) {
  Scene scene = *make_scene(name);
  if (auto* lidar = std::get_if<SpinningLidar>(&scene.sensor)) {
    lidar->range_sigma_m = 0.0;
    lidar->dropout = 0.0;
    lidar->azimuth_step_rad *= 4.0;
  } else {
    std::get<DepthCamera>(scene.sensor).stride = 8;
  }
  return scene;
}

SpinningLidar& lidar_of(Scene& scene) { return std::get<SpinningLidar>(scene.sensor); }

double azimuth_from_ahead(const LidarReturn& r) {
  const double azimuth = std::atan2(r.p_lidar.y(), r.p_lidar.x());
  return azimuth < 0.0 ? azimuth + 2.0 * M_PI : azimuth;
}

// Distance of a return from the surface its own ray meets, sensor and world as at its firing.
double range_error(const Scene& scene, const LidarReturn& r) {
  const double fired = scene.exposure_s(kFrame) + r.from_exposure_ns / 1e9;
  const Eigen::Isometry3d T = scene.T_world_lidar(fired);
  const Eigen::Vector3d p = r.p_lidar.cast<double>();
  const auto hit =
      Snapshot(scene.world, fired).intersect({T.translation(), T.linear() * p.normalized()}, 1e3);
  return hit ? p.norm() - hit->distance : 1e9;
}

TEST(SpinningLidar, ReturnsLieOnTheWorldAsItStoodAtTheFiring) {
  for (const bool compensated : {true, false}) {
    Scene scene = noiseless("corridor");
    lidar_of(scene).motion_compensated = compensated;
    const Sweep sweep = scene.sweep(kFrame);
    ASSERT_GT(sweep.returns.size(), 3000U);
    EXPECT_EQ(sweep.motion_compensated, compensated);
    // Where a beam grazes an edge, rounding to float may decide; everywhere else it may not.
    const auto off = std::count_if(sweep.returns.begin(), sweep.returns.end(), [&](const auto& r) {
      return std::abs(range_error(scene, r)) > 1e-3;
    });
    EXPECT_LE(off, 5);
  }
}

TEST(SpinningLidar, FiresFromTheLeftRearRoundTheFrontToTheRightRear) {
  Scene scene = noiseless("corridor");
  lidar_of(scene).motion_compensated = false;
  for (const LidarReturn& r : scene.sweep(kFrame).returns) {
    const double azimuth = std::atan2(r.p_lidar.y(), r.p_lidar.x());
    EXPECT_NEAR(r.from_exposure_ns / 1e9, -azimuth / (2.0 * M_PI) * 0.1, 1e-6);
  }
}

TEST(SpinningLidar, StoresRingAfterRingFromStraightAheadTopToBottom) {
  const Sweep sweep = noiseless("street").sweep(kFrame);
  double last_elevation = 1.0;
  std::size_t wraps = 0;
  for (std::size_t i = 1; i < sweep.returns.size(); ++i) {
    const LidarReturn& before = sweep.returns[i - 1];
    const LidarReturn& now = sweep.returns[i];
    if (now.ring == before.ring) {
      EXPECT_GT(azimuth_from_ahead(now), azimuth_from_ahead(before));
      continue;
    }
    EXPECT_EQ(now.ring, before.ring + 1);
    const double elevation = std::asin(now.p_lidar.z() / now.p_lidar.norm());
    EXPECT_LT(elevation, last_elevation);
    last_elevation = elevation;
    ++wraps;
  }
  EXPECT_EQ(wraps, 63U);
}

TEST(SpinningLidar, RangeNoiseHasTheSigmaAskedFor) {
  Scene scene = noiseless("corridor");
  lidar_of(scene).range_sigma_m = 0.02;
  double squares = 0.0;
  int count = 0;
  for (const LidarReturn& r : scene.sweep(kFrame).returns) {
    const double error = range_error(scene, r);
    if (std::abs(error) > 0.2) continue;
    squares += error * error;
    ++count;
  }
  EXPECT_NEAR(std::sqrt(squares / count), 0.02, 0.002);
}

TEST(SpinningLidar, StoresOnlyTheFieldAskedFor) {
  Scene scene = noiseless("street");
  lidar_of(scene).azimuth_limit_rad = 0.8;
  for (const LidarReturn& r : scene.sweep(kFrame).returns) {
    EXPECT_LE(std::abs(std::atan2(r.p_lidar.y(), r.p_lidar.x())), 0.8 + 1e-6);
  }
}

TEST(DepthCamera, ReturnsProjectOntoItsPixelsAtTheImagesDepth) {
  Scene scene = noiseless("desk");
  auto& sensor = std::get<DepthCamera>(scene.sensor);
  sensor.sigma_base_m = sensor.sigma_growth = 0.0;
  const double exposure = scene.exposure_s(kFrame);
  const auto depth =
      render_depth(scene.world, scene.rig.camera, scene.T_world_camera(exposure), exposure);
  const Sweep sweep = scene.sweep(kFrame);
  ASSERT_GT(sweep.returns.size(), 1000U);
  for (const LidarReturn& r : sweep.returns) {
    const Eigen::Vector3d p_camera = scene.rig.T_camera_lidar * r.p_lidar.cast<double>();
    const Eigen::Vector2d pixel = *project(scene.rig.camera, p_camera);
    const auto u = static_cast<std::size_t>(std::lround(pixel.x()));
    const auto v = static_cast<std::size_t>(std::lround(pixel.y()));
    EXPECT_EQ(v, 8U * r.ring);
    EXPECT_EQ(u % 8U, 0U);
    EXPECT_NEAR(p_camera.z(), depth[v * 640U + u], 1e-3);
  }
}

TEST(Scanner, SameSeedSameSweep) {
  const Scene scene = *make_scene("desk");
  const Sweep a = scene.sweep(3);
  const Sweep b = scene.sweep(3);
  ASSERT_EQ(a.returns.size(), b.returns.size());
  for (std::size_t i = 0; i < a.returns.size(); ++i) {
    EXPECT_EQ(a.returns[i].p_lidar, b.returns[i].p_lidar);
  }
}

}  // namespace
}  // namespace sparsight::synthetic
