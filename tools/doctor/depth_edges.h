#pragma once

#include <Eigen/Core>
#include <chrono>
#include <vector>

#include "hal/calibration.h"
#include "hal/sweep.h"

namespace sparsight {

struct DepthEdgeConfig {
  // Returns fired further from the exposure are left out: the rig may be moving, and nothing here
  // knows how. Of three frames in a turn of the head, one sees all that it shows within this time.
  std::chrono::nanoseconds most_from_exposure = std::chrono::milliseconds(30);
  double least_jump_m = 0.1;
  double least_jump = 0.03;   // of the range
  double most_jump_m = 3.0;   // a greater one weighs no more
  double most_gap_deg = 0.7;  // between neighbours; at 600 rpm they are 0.2 apart
};

// Where a thing ends and what is behind it begins, seen by the LiDAR.
struct DepthEdge {
  Eigen::Vector3d p_camera;  // on the near side
  double weight = 0.0;       // the root of the jump
};

// Along each ring, between a return and a neighbour far behind it: the border lies half-way between
// the two firings, at the distance of the near one (Levinson and Thrun 2013, "Automatic online
// calibration of cameras and lasers", Sec. III-A).
std::vector<DepthEdge> depth_edges(const Sweep& sweep, const RigCalibration& rig,
                                   const DepthEdgeConfig& config = {});

}  // namespace sparsight
