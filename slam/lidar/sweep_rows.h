#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "slam/lidar/sweep_surface.h"

namespace sparsight {

// The rings of a sweep by elevation, those closer than 1.6 degrees taken together: a scanner of 64
// rings then has as many rows as one of 16.
class SweepRows {
 public:
  explicit SweepRows(std::span<const SweepPoint> points);

  int count() const { return static_cast<int>(elevation_rad_.size()); }
  int of_ring(std::uint16_t ring) const { return of_ring_[ring]; }
  // The row nearest to an elevation; -1 if it is out of their sight.
  int at(double elevation_rad) const;

 private:
  std::vector<int> of_ring_;
  std::vector<double> elevation_rad_;  // ascending
};

// Of a point above the LiDAR's horizontal plane.
float elevation_rad(const Eigen::Vector3f& p_lidar);

}  // namespace sparsight
