#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <numbers>
#include <variant>
#include <vector>

#include "hal/calibration.h"
#include "hal/sweep.h"
#include "tests/synthetic/world.h"

namespace sparsight::synthetic {

// A rotating LiDAR that turns to the right (as Velodyne's do, seen from above) and looks straight
// ahead in the middle of its turn, which is the exposure: KITTI's arrangement.
struct SpinningLidar {
  std::vector<double> elevations_rad;  // one per ring, top to bottom
  double azimuth_step_rad = 0.17 * std::numbers::pi / 180.0;
  double azimuth_limit_rad = std::numbers::pi;  // to either side; what lies beyond is not stored
  double period_s = 0.1;
  double range_sigma_m = 0.02;
  double min_range_m = 0.9;
  double max_range_m = 120.0;
  double dropout = 0.03;  // share of the returns that is lost
  // Every firing from where the sensor was at that time; else all at the exposure.
  bool motion_compensated = true;
};

SpinningLidar hdl64();  // Velodyne HDL-64E: 64 rings from +2 to -24.33 degrees
SpinningLidar vlp16();  // Velodyne VLP-16: 16 rings from +15 to -15 degrees

// An RGB-D camera's depth image, registered to the grey camera, as a scan: a ring per row.
struct DepthCamera {
  int stride = 2;  // pixels between points, along and across
  double min_depth_m = 0.5;
  double max_depth_m = 5.0;
  // Standard deviation of structured light, base + growth (z - 0.4)^2 (Nguyen et al. 2012).
  double sigma_base_m = 0.0012;
  double sigma_growth = 0.0019;
};

using DepthSensor = std::variant<SpinningLidar, DepthCamera>;

// The sweep around the image exposed at this time. The trajectory is the LiDAR's.
Sweep scan(const World& world, const DepthSensor& sensor, const RigCalibration& rig,
           const std::function<Eigen::Isometry3d(double)>& T_world_lidar, double exposure_s,
           std::uint64_t seed);

}  // namespace sparsight::synthetic
