#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "hal/result.h"
#include "hal/time.h"
#include "slam/tracked_frame.h"

namespace sparsight {

// One line of the session's journal.
struct FrameRecord {
  std::uint64_t sequence = 0;
  HostTime exposure;
  FrameOutcome outcome;
  std::chrono::nanoseconds tracking_time{};  // TrackingStage::track
  std::chrono::nanoseconds window_time{};    // WindowStage, zero if it was not a keyframe
  std::vector<Error> faults;
};

struct TrajectoryPose {
  std::uint64_t sequence = 0;
  HostTime exposure;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  bool known = true;  // false while tracking was lost: the pose is the last that was known
};

}  // namespace sparsight
