#include "drivers/recording/event_decoder.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "drivers/recording/camera_messages.h"
#include "drivers/recording/lidar_messages.h"
#include "drivers/recording/state_messages.h"

namespace sparsight {
namespace {

HostTime host_time(std::uint64_t log_time) {
  constexpr std::uint64_t kLast = std::numeric_limits<std::int64_t>::max();
  return HostTime(std::chrono::nanoseconds(static_cast<std::int64_t>(std::min(log_time, kLast))));
}

template <typename Event>
bool decode_as(bool (*read)(Bytes, Event&), Bytes data, std::vector<RigEvent>& events) {
  Event event{};
  if (!read(data, event)) return false;
  events.emplace_back(event);
  return true;
}

}  // namespace

bool EventDecoder::decode(RecordingTopic topic, const mcap::Message& message,
                          std::vector<RigEvent>& events) {
  switch (topic) {
    case RecordingTopic::kFrameInfo:
      pending_ = PendingInfo{message.log_time, {}};
      if (read_frame_info(message.data, pending_->frame)) return true;
      pending_.reset();
      return false;
    case RecordingTopic::kImage:
    case RecordingTopic::kCompressedImage:
      return decode_image(topic, message, events);
    case RecordingTopic::kPackets: {
      const bool sound = read_scan(message.data, packets_);
      events.insert(events.end(), packets_.begin(), packets_.end());
      return sound;
    }
    case RecordingTopic::kPositions:
      return decode_as(read_position, message.data, events);
    case RecordingTopic::kEdges:
      return decode_as(read_edge, message.data, events);
    case RecordingTopic::kDeviceStates:
      return decode_as(read_device_state, message.data, events);
    default:
      return true;
  }
}

bool EventDecoder::decode_image(RecordingTopic topic, const mcap::Message& message,
                                std::vector<RigEvent>& events) {
  const std::optional<PendingInfo> info = std::exchange(pending_, std::nullopt);
  auto frame = std::make_shared<CameraFrame>();
  bool sound = false;
  if (info && info->log_time == message.log_time) {
    *frame = info->frame;
    sound = topic == RecordingTopic::kImage ? read_image_bytes(message.data, *frame)
                                            : read_compressed_bytes(message.data, *frame);
  } else if (topic == RecordingTopic::kImage) {
    frame->sequence = message.sequence;
    frame->arrival = host_time(message.log_time);
    sound = read_foreign_image(message.data, *frame);
  }
  if (sound) events.emplace_back(std::shared_ptr<const CameraFrame>(std::move(frame)));
  return sound;
}

}  // namespace sparsight
