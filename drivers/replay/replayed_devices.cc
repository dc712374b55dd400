#include "drivers/replay/replayed_devices.h"

namespace sparsight {

std::optional<CameraFrame> ReplayedCamera::read(std::chrono::nanoseconds /*patience*/) {
  const auto frame = replay_.next<std::shared_ptr<const CameraFrame>>();
  if (!frame) {
    last_sequence_.reset();
    return std::nullopt;
  }
  count(**frame);
  return **frame;
}

void ReplayedCamera::count(const CameraFrame& frame) {
  ++counters_.frames;
  if (frame.damaged) ++counters_.damaged;
  if (last_sequence_) {
    if (frame.epoch != last_epoch_) {
      ++counters_.restarts;
    } else if (frame.sequence > *last_sequence_) {
      counters_.lost += frame.sequence - *last_sequence_ - 1;
    }
  }
  last_sequence_ = frame.sequence;
  last_epoch_ = frame.epoch;
}

std::optional<LidarMessage> ReplayedLidar::read(std::chrono::nanoseconds /*patience*/) {
  auto message = replay_.next_of_two<LidarPacket, PositionPacket>();
  if (!message) return std::nullopt;
  ++(std::holds_alternative<LidarPacket>(*message) ? counters_.packets : counters_.positions);
  return message;
}

std::optional<Edge> ReplayedTriggerLine::read(std::chrono::nanoseconds /*patience*/) {
  auto edge = replay_.next<Edge>();
  if (edge) ++counters_.edges;
  return edge;
}

}  // namespace sparsight
