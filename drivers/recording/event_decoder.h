#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "drivers/recording/mcap_records.h"
#include "drivers/recording/recording_topics.h"
#include "hal/rig_event.h"

namespace sparsight {

// Messages of a recording to the events they were made of. Thread-bound.
class EventDecoder {
 public:
  // Appends the events that the message completes, often one; none for a topic that holds nothing
  // raw. False if the message is not sound.
  bool decode(RecordingTopic topic, const mcap::Message& message, std::vector<RigEvent>& events);

 private:
  bool decode_image(RecordingTopic topic, const mcap::Message& message,
                    std::vector<RigEvent>& events);

  struct PendingInfo {
    std::uint64_t log_time = 0;
    CameraFrame frame;
  };
  std::optional<PendingInfo> pending_;  // of the image that comes next
  std::vector<LidarPacket> packets_;    // reused
};

}  // namespace sparsight
