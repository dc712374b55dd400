#include "tools/session/session_summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sparsight {
namespace {

StageTiming timing_of(std::vector<double> times_ms) {
  StageTiming timing{.calls = times_ms.size()};
  if (times_ms.empty()) return timing;
  timing.max_ms = *std::max_element(times_ms.begin(), times_ms.end());
  timing.median_ms = percentile(times_ms, 0.5);
  timing.p99_ms = percentile(std::move(times_ms), 0.99);
  return timing;
}

double path_length_of(const std::vector<TrajectoryPose>& trajectory) {
  double length = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length += (trajectory[i].T_world_camera.translation() -
               trajectory[i - 1].T_world_camera.translation())
                  .norm();
  }
  return length;
}

void count_frames(const std::vector<FrameFigures>& frames, SessionSummary& summary) {
  std::vector<double> tracking_ms;
  std::vector<double> window_ms;
  for (const FrameFigures& frame : frames) {
    using Status = FrameOutcome::Status;
    ++(frame.status == Status::kLost        ? summary.lost
       : frame.status == Status::kPredicted ? summary.predicted
                                            : summary.tracked);
    tracking_ms.push_back(to_milliseconds(frame.tracking_time));
    if (!frame.keyframe) continue;
    ++summary.keyframes;
    window_ms.push_back(to_milliseconds(frame.window_time));
  }
  summary.frames = frames.size();
  summary.tracking = timing_of(std::move(tracking_ms));
  summary.window = timing_of(std::move(window_ms));
}

}  // namespace

double percentile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  const auto index = static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::nth_element(values.begin(), values.begin() + index, values.end());
  return values[static_cast<std::size_t>(index)];
}

SessionSummary summarize(const Session& session) {
  SessionSummary summary;
  count_frames(session.frames, summary);
  summary.path_length_m = path_length_of(session.trajectory);
  if (!session.frames.empty()) {
    summary.recorded_s =
        to_seconds(session.frames.back().exposure - session.frames.front().exposure);
  }
  const double wall_s = to_seconds(session.wall_time);
  if (wall_s > 0.0) {
    summary.frames_per_s = static_cast<double>(summary.frames) / wall_s;
    summary.realtime_factor = summary.recorded_s / wall_s;
  }
  return summary;
}

std::vector<Gap> gaps_of(const std::vector<TrajectoryPose>& trajectory) {
  std::vector<Gap> gaps;
  for (std::size_t i = 0; i < trajectory.size();) {
    if (trajectory[i].known) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < trajectory.size() && !trajectory[end].known) ++end;
    const HostTime from = trajectory[i > 0 ? i - 1 : i].exposure;
    const HostTime to = trajectory[std::min(end, trajectory.size() - 1)].exposure;
    gaps.push_back({.first = trajectory[i].sequence,
                    .last = trajectory[end - 1].sequence,
                    .seconds = to_seconds(to - from)});
    i = end;
  }
  return gaps;
}

std::optional<Error> failure_of(const Session& session) {
  const std::string source = session.description.source.string();
  if (session.broke_off) return Error{ErrorCode::kMalformed, source + ": " + *session.broke_off};
  const SessionSummary summary = summarize(session);
  if (summary.frames == 0) return Error{ErrorCode::kNotFound, source + ": gave no frame"};
  // The first frame counts as tracked without having been.
  if (summary.frames > 1 && summary.tracked <= 1) {
    return Error{ErrorCode::kMalformed,
                 source + ": no frame could be tracked; report.html shows what was tried"};
  }
  return std::nullopt;
}

void tell_camera_found(const CameraIntrinsics& given, const CameraIntrinsics& found,
                       Session& session) {
  if (found.fx == given.fx && found.k1 == given.k1) return;
  session.notes.push_back(fmt::format(
      "the images show a camera with focal length x {:.4f} and k1 {:+.4f} beside the given one",
      found.fx / given.fx, found.k1 - given.k1));
}

}  // namespace sparsight
