#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace sparsight {

// One LiDAR return, in the LiDAR frame at the instant of its own firing.
struct LidarReturn {
  Eigen::Vector3f p_lidar;            // metres
  float intensity = 0.0F;             // as the data source scales it
  std::int32_t from_exposure_ns = 0;  // firing time minus the image's exposure time
  std::uint16_t ring = 0;             // laser, in the order of storage
};

// The returns that go with one image. Of a ring, neighbours in `returns` are neighbours in azimuth.
struct Sweep {
  std::vector<LidarReturn> returns;
  // All returns are already expressed in the LiDAR frame at the exposure (from_exposure_ns is 0).
  bool motion_compensated = false;
};

}  // namespace sparsight
