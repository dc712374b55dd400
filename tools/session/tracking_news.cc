#include "tools/session/tracking_news.h"

#include <fmt/format.h>

#include <utility>

namespace sparsight {

std::optional<std::string> TrackingNews::of(const FrameRecord& record) {
  const FrameOutcome& outcome = record.outcome;
  const bool lost = outcome.status == FrameOutcome::Status::kLost;
  const bool was_lost = std::exchange(lost_, lost);
  const std::uint32_t submap = std::exchange(submap_, outcome.submap);
  if (lost && !was_lost) {
    return fmt::format("frame {}: lost: where the camera is is not known from here on",
                       record.sequence);
  }
  if (lost) return std::nullopt;
  if (outcome.submap != submap) {
    return fmt::format(
        "frame {}: tracking goes on in sub-map {}; known places are looked for, to find where that "
        "is",
        record.sequence, outcome.submap);
  }
  if (!was_lost) return std::nullopt;
  return fmt::format("frame {}: found again, beside the last keyframe", record.sequence);
}

}  // namespace sparsight
