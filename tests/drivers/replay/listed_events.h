#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "hal/rig_event.h"

namespace sparsight {

// The events it is given, one after another.
class ListedEvents final : public RigEventSource {
 public:
  explicit ListedEvents(std::vector<RigEvent> events) : events_(std::move(events)) {}
  std::optional<RigEvent> next() override {
    if (at_ == events_.size()) return std::nullopt;
    return events_[at_++];
  }

 private:
  std::vector<RigEvent> events_;
  std::size_t at_ = 0;
};

}  // namespace sparsight
