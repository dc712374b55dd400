#include "drivers/vlp16/realtime_bridge.h"

#include <gtest/gtest.h>

namespace sparsight {
namespace {

using namespace std::chrono_literals;

ClockPair clocks(std::chrono::nanoseconds realtime, std::chrono::nanoseconds monotonic) {
  return {realtime, HostTime(monotonic)};
}

TEST(RealtimeBridge, MovesStampsByTheDifferenceOfTheClocks) {
  RealtimeBridge bridge;
  bridge.update(clocks(1000s, 10s));
  EXPECT_EQ(bridge.to_host(999s + 999ms), HostTime(9s + 999ms));
}

TEST(RealtimeBridge, FollowsAClockThatIsSlewed) {
  RealtimeBridge bridge;
  bridge.update(clocks(1000s, 10s));
  bridge.update(clocks(1001s + 500us, 11s));  // 500 ppm, the most that NTP does
  EXPECT_EQ(bridge.to_host(1001s + 500us - 1ms), HostTime(11s - 1ms));
}

TEST(RealtimeBridge, KnowsStampsOfBeforeTheClockWasSet) {
  RealtimeBridge bridge;
  for (const auto step : {5000s, -5000s}) {
    bridge.update(clocks(1000s, 10s));
    bridge.update(clocks(1000s + step + 10ms, 10s + 10ms));
    EXPECT_EQ(bridge.to_host(1000s + 3ms), HostTime(10s + 3ms)) << "stamped, then set";
    EXPECT_EQ(bridge.to_host(1000s + step + 8ms), HostTime(10s + 8ms)) << "set, then stamped";
  }
}

TEST(RealtimeBridge, ASmallStepIsNoticedToo) {
  RealtimeBridge bridge;
  bridge.update(clocks(1000s, 10s));
  bridge.update(clocks(1000s + 10ms + 50ms, 10s + 10ms));
  EXPECT_EQ(bridge.to_host(1000s + 3ms), HostTime(10s + 3ms));
  EXPECT_EQ(bridge.to_host(1000s + 58ms), HostTime(10s + 8ms));
}

TEST(RealtimeBridge, NothingArrivesInTheFuture) {
  RealtimeBridge bridge;
  bridge.update(clocks(1000s, 10s));
  EXPECT_EQ(bridge.to_host(1000s + 1ms), HostTime(10s));
}

TEST(RealtimeBridge, AStampWithoutSenseCountsAsNow) {
  RealtimeBridge bridge;
  bridge.update(clocks(1000s, 10s));
  bridge.update(clocks(1001s, 11s));
  EXPECT_EQ(bridge.to_host(0s), HostTime(11s)) << "no stamp at all";
  EXPECT_EQ(bridge.to_host(2000s), HostTime(11s));
}

TEST(RealtimeBridge, ReadsBothClocksAsOne) {
  const ClockPair first = read_clocks();
  const ClockPair second = read_clocks();
  const auto apart = (second.realtime - first.realtime) - (second.monotonic - first.monotonic);
  EXPECT_GE(second.monotonic, first.monotonic);
  EXPECT_LT(std::chrono::abs(apart), 20ms);
}

}  // namespace
}  // namespace sparsight
