#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hal/calibration.h"
#include "realtime/pipeline/deterministic_replay.h"
#include "tools/evaluation/evaluation.h"
#include "tools/session/fault_log.h"
#include "tools/session/frame_figures.h"

namespace sparsight {

// Known before the first frame.
struct SessionDescription {
  std::filesystem::path source;
  std::string profile_name;
  OdometryConfig config;
  std::optional<int> rays;  // none: all the scans have
  int camera = 0;
  RigCalibration calibration;
  float full_intensity = 255.0F;  // of the LiDAR's brightest return
};

// Milliseconds.
struct StageTimes {
  double median_ms = 0.0;
  double p99_ms = 0.0;
  double max_ms = 0.0;
};

// The true path and what the comparison says.
struct GroundTruth {
  std::filesystem::path file;
  Evaluation evaluation;
  // Where the evaluated frames (evaluation.estimate_indices) were in truth, in the session's world:
  // the first of them stands where the estimate has it.
  std::vector<Eigen::Vector3d> positions;
};

// What a live run says of itself beyond what a replay does.
struct LiveFigures {
  StageTimes exposure_to_pose;
  StageTimes arrival_to_pose;  // from the camera's frame being there
  StageTimes wake_up;          // of the tracking thread, after it was due
  std::uint64_t deadlines_missed = 0;
  std::uint64_t frames_dropped = 0;     // by us, before they were tracked
  std::uint64_t events_unrecorded = 0;  // by us, raw ones
  std::uint64_t work_left_out = 0;      // previews, loop searches, iterations, levels,
                                        // the ends of searches for a pose
  std::optional<double> first_pose_s;   // after the camera's first frame
  double cpu_share = 0.0;               // of one processor
  std::uint64_t resident_bytes = 0;     // at the end
};

// Everything a session leaves behind but the map.
struct Session {
  SessionDescription description;
  std::vector<FrameFigures> frames;
  std::vector<TrajectoryPose> trajectory;  // corrected, if loops were looked for
  std::vector<TrajectoryPose> odometry;    // uncorrected; empty if loops were not looked for
  std::vector<LoopClosure> loops;          // that stand
  std::vector<Submap> submaps;             // the first begins where the session does
  LoopStatistics loop_statistics;
  std::vector<std::uint64_t> keyframes;  // their frames' sequence numbers
  FaultLog faults;
  std::size_t map_points = 0;
  std::chrono::nanoseconds wall_time{};  // reading included
  bool complete = false;                 // the source was read to its end (or to --max-frames)
  std::optional<std::string> broke_off;  // why it was not
  std::optional<GroundTruth> truth;
  std::optional<LiveFigures> live;
  std::vector<std::string> notes;  // what a person must know before trusting the figures
};

}  // namespace sparsight
