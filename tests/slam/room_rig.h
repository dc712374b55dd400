#pragma once

#include <chrono>
#include <cmath>
#include <cstdint>

#include "hal/calibration.h"
#include "hal/frame_source.h"
#include "slam/odometry_config.h"
#include "tests/slam/sine_room.h"

namespace sparsight {

// Camera and LiDAR, 10 Hz, moved through the room along a gentle curve.
struct RoomRig {
  static constexpr double kFrameSeconds = 0.1;

  SineRoom room;
  Eigen::Isometry3d T_camera_lidar = mount();
  double speed_m_s = 0.6;
  double turn_rad_s = 0.06;
  Eigen::Isometry3d T_world_start = Eigen::Isometry3d::Identity();

  static Eigen::Isometry3d mount() {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    T.translation() = Eigen::Vector3d(0.02, -0.1, -0.05);
    return T;
  }
  RigCalibration calibration() const { return {room.intrinsics, T_camera_lidar}; }

  Eigen::Isometry3d T_world_camera(int i) const { return T_world_camera_at(kFrameSeconds * i); }
  Eigen::Isometry3d T_world_camera_at(double t) const {
    return T_world_start * pose(0.02 * std::sin(t), turn_rad_s * t, 0.0, 0.1 * std::sin(0.5 * t),
                                0.0, speed_m_s * t);
  }

  SynchronizedFrame frame(int i) const {
    SynchronizedFrame result;
    result.sequence = static_cast<std::uint64_t>(i);
    result.exposure = HostTime(std::chrono::milliseconds(100 * i));
    result.grey = room.image(T_world_camera(i));
    result.sweep = sweep(i);
    return result;
  }

  // Rings every 0.8 degrees, seen from the LiDAR's own place.
  Sweep sweep(int i) const {
    Sweep result{.motion_compensated = true};
    const Eigen::Isometry3d T_world_lidar = T_world_camera(i) * T_camera_lidar;
    for (int ring = 0; ring < 60; ++ring) {
      for (int column = 0; column < 90; ++column) {
        const double elevation = 0.014 * (30 - ring);
        const double azimuth = 0.014 * (45 - column);
        const Eigen::Vector3d ray(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        const Eigen::Vector3d p_world =
            room.wall_along(T_world_lidar.translation(), T_world_lidar.linear() * ray);
        result.returns.push_back({.p_lidar = (T_world_lidar.inverse() * p_world).cast<float>(),
                                  .intensity = 0.5F,
                                  .ring = static_cast<std::uint16_t>(ring)});
      }
    }
    return result;
  }
};

inline OdometryConfig room_config() {
  OdometryConfig config;
  config.tracker.pyramid_levels = 3;
  config.points.surface_slope = true;
  return config;
}

}  // namespace sparsight
