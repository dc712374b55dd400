#include "drivers/replay/played_events.h"

#include <gtest/gtest.h>

#include <utility>

#include "drivers/replay/repeated_events.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;

class NumberedEdges final : public RigEventSource {
 public:
  explicit NumberedEdges(int count) : count_(count) {}
  std::optional<RigEvent> next() override {
    if (at_ == count_) return std::nullopt;
    return Edge{EdgeLine::kExposure, true, HostTime(std::chrono::seconds(++at_))};
  }

 private:
  int count_;
  int at_ = 0;
};

TEST(PlayedEvents, MovesEveryTimeOfEveryKindOfEvent) {
  auto frame = std::make_shared<CameraFrame>();
  frame->driver_time = HostTime(5s);
  frame->arrival = HostTime(6s);
  frame->bytes = {1, 2, 3};
  const RigEvent later = moved(std::shared_ptr<const CameraFrame>(frame), 100s);
  const auto& moved_frame = std::get<std::shared_ptr<const CameraFrame>>(later);
  EXPECT_EQ(moved_frame->driver_time, HostTime(105s));
  EXPECT_EQ(moved_frame->arrival, HostTime(106s));
  EXPECT_EQ(moved_frame->bytes, frame->bytes);
  EXPECT_EQ(arrival_of(moved(Edge{EdgeLine::kPps, true, HostTime(7s)}, 1s)), HostTime(8s));
  EXPECT_EQ(arrival_of(moved(LidarPacket{.arrival = HostTime(7s)}, -1s)), HostTime(6s));
  EXPECT_EQ(arrival_of(moved(PositionPacket{.arrival = HostTime(7s)}, 1s)), HostTime(8s));
  const DeviceStateChange gone{DeviceKind::kCamera, DeviceState::kGone, HostTime(7s)};
  EXPECT_EQ(arrival_of(moved(gone, 1s)), HostTime(8s));
}

TEST(PlayedEvents, GivesAllInOrderThoughItReadsAheadByAFew) {
  PlayedEvents played(std::make_unique<NumberedEdges>(100), 10s, 4);
  for (int i = 1; i <= 100; ++i) {
    const auto event = played.next();
    ASSERT_TRUE(event.has_value());
    EXPECT_EQ(arrival_of(*event), HostTime(10s + std::chrono::seconds(i)));
  }
  EXPECT_FALSE(played.next().has_value());
  EXPECT_FALSE(played.next().has_value());
}

TEST(RepeatedEvents, GoOnWithTheTimeAndRestartTheCamera) {
  class OneFrame final : public RigEventSource {
   public:
    std::optional<RigEvent> next() override {
      if (std::exchange(done_, true)) return std::nullopt;
      auto frame = std::make_shared<CameraFrame>();
      frame->epoch = 5;
      frame->arrival = HostTime(50s);
      return std::shared_ptr<const CameraFrame>(std::move(frame));
    }

   private:
    bool done_ = false;
  };
  RepeatedEvents repeated(
      []() -> Result<std::unique_ptr<RigEventSource>> { return std::make_unique<OneFrame>(); }, 3);
  for (std::uint32_t lap = 0; lap < 3; ++lap) {
    const auto event = repeated.next();
    ASSERT_TRUE(event.has_value());
    const auto& frame = std::get<std::shared_ptr<const CameraFrame>>(*event);
    EXPECT_EQ(frame->epoch, 5 + lap);
    EXPECT_EQ(frame->arrival, HostTime(50s + lap * 100ms));
  }
  EXPECT_FALSE(repeated.next().has_value());
}

TEST(PlayedEvents, CanBeLeftBeforeItsEnd) {
  PlayedEvents played(std::make_unique<NumberedEdges>(1000), 0s, 4);
  EXPECT_TRUE(played.next().has_value());
}

}  // namespace
}  // namespace sparsight
