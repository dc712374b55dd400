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
