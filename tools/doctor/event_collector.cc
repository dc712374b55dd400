#include "tools/doctor/event_collector.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace sparsight {
namespace {

class CollectedEvents final : public RigEventSource {
 public:
  explicit CollectedEvents(std::vector<RigEvent> events) : events_(std::move(events)) {}
  std::optional<RigEvent> next() override {
    if (next_ == events_.size()) return std::nullopt;
    return std::move(events_[next_++]);
  }

 private:
  std::vector<RigEvent> events_;
  std::size_t next_ = 0;
};

}  // namespace

void EventCollector::add(RigEvent event) {
  const std::lock_guard lock(mutex_);
  auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&event);
  if (frame != nullptr) {
    bytes_ += (*frame)->bytes.size();
    if (bytes_ > most_bytes_) {
      auto bare = std::make_shared<CameraFrame>(**frame);
      bare->bytes.clear();
      *frame = std::move(bare);
    }
  }
  events_.push_back(std::move(event));
}

std::unique_ptr<RigEventSource> EventCollector::take() {
  const std::lock_guard lock(mutex_);
  std::ranges::stable_sort(events_, {}, [](const RigEvent& event) { return arrival_of(event); });
  bytes_ = 0;
  return std::make_unique<CollectedEvents>(std::exchange(events_, {}));
}

}  // namespace sparsight
