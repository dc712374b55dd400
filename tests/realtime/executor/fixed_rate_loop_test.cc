#include "realtime/executor/fixed_rate_loop.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/realtime/executor/fake_clock.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;

TEST(FixedRateLoop, WakesAtAbsoluteTimesHoweverLongTheWorkTakes) {
  FakeClock clock;
  const HostTime start = clock.now();
  FixedRateLoop loop(clock, 10ms, start + 10ms);
  for (int i = 1; i <= 5; ++i) {
    const LoopTick tick = loop.wait();
    EXPECT_EQ(tick.due, start + i * 10ms);
    EXPECT_EQ(tick.woke, tick.due);
    EXPECT_FALSE(tick.overran);
    clock.advance(i * 1ms);
  }
}

TEST(FixedRateLoop, StartsLateAfterAnOverrunAndKeepsItsPhase) {
  FakeClock clock;
  const HostTime start = clock.now();
  FixedRateLoop loop(clock, 10ms, start);
  loop.wait();
  clock.advance(13ms);
  const LoopTick late = loop.wait();
  EXPECT_TRUE(late.overran);
  EXPECT_EQ(late.due, start + 10ms);
  EXPECT_EQ(late.woke, start + 13ms) << "at once, not a period later";
  EXPECT_EQ(late.left_out, 0U);
  EXPECT_EQ(loop.wait().woke, start + 20ms) << "back on the grid";
  EXPECT_EQ(loop.overruns(), 1U);
}

RC_GTEST_PROP(FixedRateLoop, StaysOnItsGridWhateverTheWorkTakes, ()) {
  FakeClock clock;
  const HostTime start = clock.now();
  FixedRateLoop loop(clock, 10ms, start);
  std::uint64_t ticks = 0;
  for (const int work_us : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 50'000))) {
    const LoopTick tick = loop.wait();
    ticks += tick.left_out;
    RC_ASSERT(tick.due == start + static_cast<std::int64_t>(ticks) * 10ms);
    RC_ASSERT(tick.woke >= tick.due && tick.woke < tick.due + 10ms);
    ++ticks;
    clock.advance(std::chrono::microseconds(work_us));
  }
}

TEST(FixedRateLoop, MovesItsGridWhereItIsAskedTo) {
  FakeClock clock;
  const HostTime start = clock.now();
  FixedRateLoop loop(clock, 10ms, start);
  loop.wait();
  loop.shift(-2ms);
  EXPECT_EQ(loop.wait().due, start + 8ms);
  EXPECT_EQ(loop.wait().due, start + 18ms);
}

TEST(MonotonicClock, SleepsUntilATimeAndNotAtAllUntilOneThatHasPassed) {
  MonotonicClock clock;
  const HostTime start = clock.now();
  clock.sleep_until(start - 1s);
  clock.sleep_until(HostTime{} - 1s);
  clock.sleep_until(start + 2ms);
  EXPECT_GE(clock.now(), start + 2ms);
}

}  // namespace
}  // namespace sparsight
