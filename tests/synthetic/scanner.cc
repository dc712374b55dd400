#include "tests/synthetic/scanner.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "tests/synthetic/lens.h"
#include "tests/synthetic/random.h"

namespace sparsight::synthetic {
namespace {

using TrajectoryFunction = std::function<Eigen::Isometry3d(double)>;

double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

std::optional<LidarReturn> fire(const Snapshot& snapshot, const SpinningLidar& lidar,
                                const Eigen::Isometry3d& T_world_lidar,
                                const Eigen::Vector3d& direction_lidar, Random& random) {
  const auto hit = snapshot.intersect(
      {T_world_lidar.translation(), T_world_lidar.linear() * direction_lidar}, lidar.max_range_m);
  if (!hit || random.chance(lidar.dropout)) return std::nullopt;
  const double scatter = hit->material->range_scatter_m * random.uniform(0.0, 1.0);
  const double range = hit->distance + random.gaussian(lidar.range_sigma_m) + scatter;
  if (range < lidar.min_range_m || range > lidar.max_range_m) return std::nullopt;
  const double facing = std::abs(hit->normal.dot(T_world_lidar.linear() * direction_lidar));
  LidarReturn result;
  result.p_lidar = (range * direction_lidar).cast<float>();
  result.intensity = static_cast<float>(hit->material->reflectivity * (0.4 + 0.6 * facing));
  return result;
}

Sweep concatenate(const std::vector<std::vector<LidarReturn>>& rings, bool motion_compensated) {
  Sweep sweep;
  sweep.motion_compensated = motion_compensated;
  for (const auto& ring : rings) {
    sweep.returns.insert(sweep.returns.end(), ring.begin(), ring.end());
  }
  return sweep;
}

Sweep spin(const World& world, const SpinningLidar& lidar, const TrajectoryFunction& T_world_lidar,
           double exposure_s, Random random) {
  std::vector<std::vector<LidarReturn>> rings(lidar.elevations_rad.size());
  const double turn = 2.0 * std::numbers::pi;
  std::optional<Snapshot> snapshot(std::in_place, world, exposure_s);
  Eigen::Isometry3d T = T_world_lidar(exposure_s);
  for (double stored = 0.0; stored < turn; stored += lidar.azimuth_step_rad) {
    const double azimuth = stored < turn / 2.0 ? stored : stored - turn;
    if (std::abs(azimuth) > lidar.azimuth_limit_rad) continue;
    const double late_s = lidar.motion_compensated ? 0.0 : -azimuth / turn * lidar.period_s;
    if (!lidar.motion_compensated) {
      snapshot.emplace(world, exposure_s + late_s);
      T = T_world_lidar(exposure_s + late_s);
    }
    for (std::size_t ring = 0; ring < rings.size(); ++ring) {
      const double elevation = lidar.elevations_rad[ring];
      const Eigen::Vector3d direction(std::cos(elevation) * std::cos(azimuth),
                                      std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
      auto found = fire(*snapshot, lidar, T, direction, random);
      if (!found) continue;
      found->ring = static_cast<std::uint16_t>(ring);
      found->from_exposure_ns = static_cast<std::int32_t>(std::lround(late_s * 1e9));
      rings[ring].push_back(*found);
    }
  }
  return concatenate(rings, lidar.motion_compensated);
}

std::optional<LidarReturn> measure(const Snapshot& snapshot, const DepthCamera& sensor,
                                   const RigCalibration& rig,
                                   const Eigen::Isometry3d& T_world_camera,
                                   const Eigen::Vector2d& pixel, Random& random) {
  const Eigen::Vector3d direction = pixel_direction(rig.camera, pixel);
  const auto hit = snapshot.intersect(
      {T_world_camera.translation(), T_world_camera.linear() * direction}, 2 * sensor.max_depth_m);
  if (!hit) return std::nullopt;
  // Structured light seen at a grazing angle returns nothing.
  if (std::abs(hit->normal.dot(T_world_camera.linear() * direction)) < 0.1) return std::nullopt;
  const double true_depth = hit->distance * direction.z();
  const double beyond = true_depth - 0.4;
  const double depth =
      true_depth + random.gaussian(sensor.sigma_base_m + sensor.sigma_growth * beyond * beyond);
  if (depth < sensor.min_depth_m || depth > sensor.max_depth_m) return std::nullopt;
  const Eigen::Vector3d p_camera = direction * (std::round(depth * 1e3) / 1e3 / direction.z());
  LidarReturn result;
  result.p_lidar = (rig.T_camera_lidar.inverse() * p_camera).cast<float>();
  result.intensity = static_cast<float>(hit->material->reflectivity);
  return result;
}

Sweep depth_image(const World& world, const DepthCamera& sensor, const RigCalibration& rig,
                  const TrajectoryFunction& T_world_lidar, double exposure_s, Random random) {
  const Snapshot snapshot(world, exposure_s);
  const Eigen::Isometry3d T_world_camera = T_world_lidar(exposure_s) * rig.T_camera_lidar.inverse();
  std::vector<std::vector<LidarReturn>> rows(
      static_cast<std::size_t>((rig.camera.height + sensor.stride - 1) / sensor.stride));
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (int u = 0; u < rig.camera.width; u += sensor.stride) {
      const Eigen::Vector2d pixel(u, static_cast<double>(row) * sensor.stride);
      auto found = measure(snapshot, sensor, rig, T_world_camera, pixel, random);
      if (!found) continue;
      found->ring = static_cast<std::uint16_t>(row);
      rows[row].push_back(*found);
    }
    // As KITTI stores a ring: from straight ahead to the left, round, and back from the right.
    std::reverse(rows[row].begin(), rows[row].end());
    const auto left = std::find_if(rows[row].begin(), rows[row].end(),
                                   [](const LidarReturn& r) { return r.p_lidar.y() >= 0.0F; });
    std::rotate(rows[row].begin(), left, rows[row].end());
  }
  return concatenate(rows, true);
}

}  // namespace

SpinningLidar hdl64() {
  SpinningLidar lidar;
  for (int i = 0; i < 32; ++i) lidar.elevations_rad.push_back(radians(2.0 - i / 3.0));
  for (int i = 0; i < 32; ++i) lidar.elevations_rad.push_back(radians(-8.83 - i * 0.5));
  return lidar;
}

SpinningLidar vlp16() {
  SpinningLidar lidar;
  for (int i = 0; i < 16; ++i) lidar.elevations_rad.push_back(radians(15.0 - 2.0 * i));
  lidar.azimuth_step_rad = radians(0.2);
  lidar.min_range_m = 0.5;
  lidar.max_range_m = 100.0;
  return lidar;
}

Sweep scan(const World& world, const DepthSensor& sensor, const RigCalibration& rig,
           const std::function<Eigen::Isometry3d(double)>& T_world_lidar, double exposure_s,
           std::uint64_t seed) {
  const Random random(hash(seed) ^ static_cast<std::uint64_t>(std::llround(exposure_s * 1e6)));
  if (const auto* lidar = std::get_if<SpinningLidar>(&sensor)) {
    return spin(world, *lidar, T_world_lidar, exposure_s, random);
  }
  return depth_image(world, std::get<DepthCamera>(sensor), rig, T_world_lidar, exposure_s, random);
}

}  // namespace sparsight::synthetic
