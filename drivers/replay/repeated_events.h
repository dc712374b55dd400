#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "drivers/replay/event_replay.h"
#include "hal/rig_event.h"

namespace sparsight {

// A recording over and over, its time going on: for runs longer than what was recorded. At each
// seam the camera has restarted and the LiDAR's clock has been set back, as far as anyone can tell.
// Thread-bound.
class RepeatedEvents final : public RigEventSource {
 public:
  RepeatedEvents(OpenEvents open, int times) : open_(std::move(open)), times_(times) {}

  // Ends early where the recording cannot be opened again.
  std::optional<RigEvent> next() override;

 private:
  bool open();

  OpenEvents open_;
  int times_;
  int begun_ = 0;
  std::unique_ptr<RigEventSource> events_;
  std::optional<std::chrono::nanoseconds> by_;  // of this time; known with its first event
  HostTime last_;
};

}  // namespace sparsight
