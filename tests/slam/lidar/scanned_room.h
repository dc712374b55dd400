#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "hal/sweep.h"
#include "slam/lidar/sweep_surface.h"
#include "tests/slam/sine_room.h"

namespace sparsight {

inline const Eigen::Isometry3d kHere = Eigen::Isometry3d::Identity();

// What stands in a room and does not belong to it, in the room's axes.
struct Obstacle {
  Eigen::Vector3d lowest;
  Eigen::Vector3d highest;
};

// A box of a room, seen all around by a scanner with as many rings. The LiDAR's axes are the
// room's: x forward, y left, z up; it stands 1.1 m above the floor, off the middle.
struct ScannedRoom {
  Eigen::Vector3d lowest{-7.0, -4.0, -1.1};
  Eigen::Vector3d highest{9.0, 5.0, 1.4};
  int rings = 16;
  double ring_deg = 2.0;
  double column_deg = 1.0;
  double noise_m = 0.01;
  double farthest_m = 100.0;

  double range_along(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                     const std::optional<Obstacle>& obstacle) const {
    double range = std::numeric_limits<double>::infinity();
    double enters = 0.0;
    double leaves = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      if (direction(axis) == 0.0) continue;
      const double wall = direction(axis) > 0.0 ? highest(axis) : lowest(axis);
      range = std::min(range, (wall - origin(axis)) / direction(axis));
      if (!obstacle) continue;
      const double a = (obstacle->lowest(axis) - origin(axis)) / direction(axis);
      const double b = (obstacle->highest(axis) - origin(axis)) / direction(axis);
      enters = std::max(enters, std::min(a, b));
      leaves = std::min(leaves, std::max(a, b));
    }
    return obstacle && enters < leaves ? std::min(range, enters) : range;
  }

  Sweep sweep(const Eigen::Isometry3d& T_room_lidar, std::uint32_t seed,
              const std::optional<Obstacle>& obstacle = {}) const {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, noise_m);
    Sweep result{.motion_compensated = true};
    for (int ring = 0; ring < rings; ++ring) {
      const double elevation = (ring - 0.5 * (rings - 1)) * ring_deg * M_PI / 180.0;
      for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += column_deg) {
        const double azimuth = azimuth_deg * M_PI / 180.0;
        const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        const double range =
            range_along(T_room_lidar.translation(), T_room_lidar.linear() * ray, obstacle);
        if (range > farthest_m) continue;
        result.returns.push_back({.p_lidar = ((range + noise(random)) * ray).cast<float>(),
                                  .ring = static_cast<std::uint16_t>(ring)});
      }
    }
    return result;
  }

  SweepSurface surface(const Eigen::Isometry3d& T_room_lidar,
                       const std::optional<Obstacle>& obstacle = {}) const {
    return surface_of(sweep(T_room_lidar, 1, obstacle), Eigen::Isometry3d::Identity(),
                      constant_motion(Vector6d::Zero()));
  }

  // Of a point on the wall, the floor or the ceiling.
  double distance_to_wall(const Eigen::Vector3d& p_room) const {
    return std::min((p_room - lowest).cwiseAbs().minCoeff(),
                    (p_room - highest).cwiseAbs().minCoeff());
  }
};

// A room so long that the scanner does not see its ends.
inline ScannedRoom endless_corridor() {
  return {.lowest = {-1e3, -1.2, -1.6}, .highest = {1e3, 1.3, 1.2}};
}

}  // namespace sparsight
