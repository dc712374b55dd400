#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "hal/rig_event.h"

namespace sparsight {

// Takes a copy of what a device delivers while it is being watched.
using EventSink = std::function<void(RigEvent)>;

// What the devices of a live rig delivered, each on its thread. Thread-safe.
class EventCollector {
 public:
  // Beyond so much, frames are kept without their pixels.
  explicit EventCollector(std::size_t most_bytes = std::size_t{300} << 20)
      : most_bytes_(most_bytes) {}

  void add(RigEvent event);
  // All of it, in the order of arrival; the collector is empty then.
  std::unique_ptr<RigEventSource> take();

 private:
  const std::size_t most_bytes_;
  std::mutex mutex_;  // guards what follows
  std::vector<RigEvent> events_;
  std::size_t bytes_ = 0;
};

}  // namespace sparsight
