#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "realtime/pipeline/deterministic_replay.h"

namespace sparsight {

// What a session keeps of each frame until its end, for statistics and charts.
struct FrameFigures {
  std::uint64_t sequence = 0;
  HostTime exposure;
  FrameOutcome::Status status = FrameOutcome::Status::kPredicted;
  bool keyframe = false;
  int points_used = 0;
  int attempts = 0;
  double sigma_grey = 0.0;
  double visible_ratio = 0.0;
  double found_share = 0.0;
  std::chrono::nanoseconds tracking_time{};
  std::chrono::nanoseconds window_time{};
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();  // as known when tracked
};

FrameFigures figures_of(const FrameRecord& record);

// "first", "tracked", "predicted" or "lost".
const char* name_of(FrameOutcome::Status status);

inline double to_milliseconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

// frames.csv: times in seconds of the source's clock, durations in milliseconds.
std::string frames_csv_header();
std::string frames_csv_line(const FrameFigures& frame);

}  // namespace sparsight
