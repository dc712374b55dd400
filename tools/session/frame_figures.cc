#include "tools/session/frame_figures.h"

#include <fmt/format.h>

namespace sparsight {

FrameFigures figures_of(const FrameRecord& record) {
  const FrameOutcome& outcome = record.outcome;
  return {.sequence = record.sequence,
          .exposure = record.exposure,
          .status = outcome.status,
          .keyframe = outcome.becomes_keyframe,
          .points_used = outcome.tracking.points_used,
          .attempts = outcome.tracking.attempts,
          .sigma_grey = outcome.tracking.residual_sigma_grey,
          .visible_ratio = outcome.tracking.visible_ratio,
          .found_share = outcome.tracking.found_share,
          .tracking_time = record.tracking_time,
          .window_time = record.window_time,
          .T_world_camera = outcome.T_world_camera};
}

const char* name_of(FrameOutcome::Status status) {
  switch (status) {
    case FrameOutcome::Status::kTracked:
      return "tracked";
    case FrameOutcome::Status::kFirst:
      return "first";
    case FrameOutcome::Status::kPredicted:
      return "predicted";
    case FrameOutcome::Status::kLost:
      return "lost";
  }
  return "unknown";
}

std::string frames_csv_header() {
  return "sequence,time,status,points,sigma,visible_ratio,found_share,attempts,keyframe,"
         "tracking_ms,window_ms\n";
}

std::string frames_csv_line(const FrameFigures& frame) {
  return fmt::format("{},{:.9f},{},{},{:.4f},{:.4f},{:.4f},{},{},{:.4f},{:.4f}\n", frame.sequence,
                     to_seconds(frame.exposure.time_since_epoch()), name_of(frame.status),
                     frame.points_used, frame.sigma_grey, frame.visible_ratio, frame.found_share,
                     frame.attempts, frame.keyframe ? 1 : 0, to_milliseconds(frame.tracking_time),
                     to_milliseconds(frame.window_time));
}

}  // namespace sparsight
