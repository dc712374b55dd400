#include <gtest/gtest.h>

#include "hal/rig_event.h"
#include "tests/contract/device_under_test.h"

// What every source of a rig's events owes: recordings, the simulated rig.
namespace sparsight::contract {
namespace {

class RigEventSourceContract : public ::testing::TestWithParam<EventSourceImplementation> {
 protected:
  std::vector<RigEvent> all_events() {
    std::vector<RigEvent> events;
    while (auto event = source_->next()) events.push_back(std::move(*event));
    return events;
  }
  std::unique_ptr<RigEventSource> source_ = GetParam().open();
};

TEST_P(RigEventSourceContract, EventsComeInTheOrderOfTheirArrival) {
  const auto events = all_events();
  ASSERT_FALSE(events.empty());
  for (std::size_t i = 1; i < events.size(); ++i) {
    EXPECT_GE(arrival_of(events[i]), arrival_of(events[i - 1])) << "event " << i;
  }
}

TEST_P(RigEventSourceContract, FramesAreThere) {
  for (const RigEvent& event : all_events()) {
    const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&event);
    if (frame) {
      ASSERT_TRUE(*frame);
    }
  }
}

TEST_P(RigEventSourceContract, StaysAtItsEnd) {
  all_events();
  EXPECT_FALSE(source_->next());
  EXPECT_FALSE(source_->next());
}

struct SameEvent {
  bool operator()(const std::shared_ptr<const CameraFrame>& a,
                  const std::shared_ptr<const CameraFrame>& b) const {
    return a->sequence == b->sequence && a->epoch == b->epoch && a->arrival == b->arrival &&
           a->driver_time == b->driver_time && a->exposure == b->exposure &&
           a->damaged == b->damaged && a->bytes == b->bytes;
  }
  bool operator()(const Edge& a, const Edge& b) const {
    return a.line == b.line && a.rising == b.rising && a.time == b.time;
  }
  bool operator()(const DeviceStateChange& a, const DeviceStateChange& b) const {
    return a.device == b.device && a.state == b.state && a.at == b.at;
  }
  bool operator()(const LidarPacket& a, const LidarPacket& b) const {
    return a.arrival == b.arrival && a.payload == b.payload;
  }
  bool operator()(const PositionPacket& a, const PositionPacket& b) const {
    return a.arrival == b.arrival && a.payload == b.payload;
  }
  template <typename A, typename B>
  bool operator()(const A&, const B&) const {
    return false;
  }
};

TEST_P(RigEventSourceContract, GivesTheSameEventsEveryTime) {
  const auto once = all_events();
  source_ = GetParam().open();
  const auto again = all_events();
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_TRUE(std::visit(SameEvent(), once[i], again[i])) << "event " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(RigEventSources, RigEventSourceContract,
                         ::testing::ValuesIn(registered<EventSourceImplementation>()),
                         NameOfImplementation());

}  // namespace
}  // namespace sparsight::contract
