#include "drivers/replay/repeated_events.h"

#include <cstdint>
#include <utility>

#include "drivers/replay/played_events.h"

namespace sparsight {
namespace {

constexpr std::chrono::milliseconds kSeam{100};

}  // namespace

bool RepeatedEvents::open() {
  if (begun_ == times_) return false;
  auto events = open_();
  if (!events) return false;
  events_ = std::move(*events);
  by_.reset();
  ++begun_;
  return true;
}

std::optional<RigEvent> RepeatedEvents::next() {
  while (events_ || open()) {
    const std::optional<RigEvent> event = events_->next();
    if (!event) {
      events_.reset();
      continue;
    }
    if (!by_) {
      by_ = begun_ == 1 ? std::chrono::nanoseconds(0) : last_ + kSeam - arrival_of(*event);
    }
    RigEvent later = moved(*event, *by_, static_cast<std::uint32_t>(begun_ - 1));
    last_ = arrival_of(later);
    return later;
  }
  return std::nullopt;
}

}  // namespace sparsight
