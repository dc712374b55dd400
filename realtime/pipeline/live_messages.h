#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <cstdint>
#include <vector>

#include "hal/frame_source.h"
#include "hal/time.h"
#include "slam/retired_keyframe.h"
#include "slam/tracked_frame.h"

namespace sparsight {

// What the threads of the live pipeline hand each other.

// A frame on its way through the stages; made at the start, passed on by pointer, reused.
struct LiveFrame {
  SynchronizedFrame frame;
  TrackedFrame tracked;
  HostTime arrival;      // of the camera's frame at the host
  HostTime ready;        // put together with its returns
  HostTime handed_over;  // to the window
};

// Of a frame that was tracked, for the journal. Copied without allocating.
struct LiveRecord {
  std::uint64_t sequence = 0;
  HostTime exposure;
  HostTime done;
  FrameOutcome outcome;
  std::chrono::nanoseconds tracking_time{};
};

struct LivePose {
  HostTime exposure;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  FrameOutcome::Status status = FrameOutcome::Status::kPredicted;
  std::uint32_t submap = 0;
};

// What loops have made of it, as far as the background has come.
struct MapPlace {
  Eigen::Isometry3d T_map_world = Eigen::Isometry3d::Identity();  // may jump
  std::uint32_t submap = 0;                                       // of the newest keyframe there
  bool placed = true;  // that sub-map is tied to the first by odometry or loops
};

// Whether it is known where a sub-map lies, of which the background may not have heard yet.
inline bool in_its_place(const MapPlace& map, std::uint32_t submap) {
  return map.placed && map.submap == submap;
}

// A pose for those who watch, in both frames.
struct LivePreview {
  LivePose pose;
  Eigen::Isometry3d T_map_world = Eigen::Isometry3d::Identity();
  bool placed = true;
};

// From the window to the journal.
struct WindowReport {
  std::uint64_t sequence = 0;
  std::chrono::nanoseconds window_time{};
};
struct SettledPose {
  std::uint64_t keyframe = 0;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

struct FrameFaults {
  std::uint64_t sequence = 0;
  std::vector<Error> faults;
};

}  // namespace sparsight
