#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tools/session/session.h"

namespace sparsight {

struct StageTiming {
  std::size_t calls = 0;
  double median_ms = 0.0;
  double p99_ms = 0.0;
  double max_ms = 0.0;
};

struct SessionSummary {
  std::size_t frames = 0;
  std::size_t tracked = 0;  // the first, which defines the world, among them
  std::size_t predicted = 0;
  std::size_t lost = 0;  // frames = tracked + predicted + lost
  std::size_t keyframes = 0;
  double recorded_s = 0.0;  // from the first exposure to the last
  double path_length_m = 0.0;
  double frames_per_s = 0.0;
  double realtime_factor = 0.0;  // recorded time over wall time
  StageTiming tracking;
  StageTiming window;
};

SessionSummary summarize(const Session& session);

// Frames in a row for which no pose is known.
struct Gap {
  std::uint64_t first = 0;  // sequence numbers
  std::uint64_t last = 0;
  double seconds = 0.0;  // from the last known pose before it to the first after it
};
std::vector<Gap> gaps_of(const std::vector<TrajectoryPose>& trajectory);

// A calibration that the images contradict is the user's to know, and to mend: a note.
void tell_camera_found(const CameraIntrinsics& given, const CameraIntrinsics& found,
                       Session& session);

// Why a session that was written is a failure all the same, if it is: it broke off, or nothing
// could be tracked.
std::optional<Error> failure_of(const Session& session);

// The smallest value that at least `share` of them do not exceed; 0 of none.
double percentile(std::vector<double> values, double share);

// session.json.
std::string session_json(const Session& session, const SessionSummary& summary);

}  // namespace sparsight
