#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "tests/synthetic/material.h"
#include "tests/synthetic/trajectory.h"

namespace sparsight::synthetic {

// A car in the lane `left_m` of the road's centre line, its LiDAR at KITTI's height. Distance along
// the road as a function of time; the body rolls and pitches a little on its springs.
Trajectory drive(const RoadBend& bend, double left_m,
                 const std::function<double(double seconds)>& along_m, double duration_s);

// Where something else on that road is, standing on the ground.
Eigen::Isometry3d on_road(const RoadBend& bend, double left_m, double along_m);

struct Walk {
  std::vector<Eigen::Vector2d> corners;  // walked in turn, cut at `corner_m` before and after
  double speed_m_s = 1.1;
  double corner_m = 1.0;
  double height_m = 1.45;
  double head_turn_rad = 0.6;      // looks to one side and the other
  double head_turn_every_s = 6.0;  // and back within about a second and a half
};

// Steps at 2 Hz: bob, sway and the wrist's small turns on top of the path.
Trajectory walk(const Walk& walk);

}  // namespace sparsight::synthetic
