#include "drivers/vlp16/sensor_clock.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using Step = SensorTimeline::Step;

constexpr std::uint32_t kHourUs = 3'600'000'000U;

SensorTime sensor_time(std::chrono::nanoseconds since) { return SensorTime(since); }
HostTime host_time(std::chrono::nanoseconds since) { return HostTime(since); }

TEST(SensorTimeline, StartsAtWhatTheSensorSays) {
  SensorTimeline timeline;
  EXPECT_EQ(timeline.advance(1'000'001, {}), Step::kForward);
  EXPECT_EQ(timeline.now(), sensor_time(1'000'001us));
  EXPECT_EQ(timeline.epoch(), 0U);
}

TEST(SensorTimeline, CountsOnOverTheHour) {
  SensorTimeline timeline;
  timeline.advance(kHourUs - 1000, {});
  EXPECT_EQ(timeline.advance(327, {}), Step::kForward);
  EXPECT_EQ(timeline.now(), sensor_time(1h + 327us));
  EXPECT_EQ(timeline.epoch(), 0U);
}

TEST(SensorTimeline, ToleratesStampsBeyondTheHour) {
  SensorTimeline timeline;
  timeline.advance(kHourUs - 500, {});
  EXPECT_EQ(timeline.advance(kHourUs + 827, {}), Step::kForward);
  EXPECT_EQ(timeline.now(), sensor_time(1h + 827us));
  // The sensor rolls over late.
  EXPECT_EQ(timeline.advance(2155, {}), Step::kForward);
  EXPECT_EQ(timeline.now(), sensor_time(1h + 2155us));
}

TEST(SensorTimeline, OneReorderedPacketIsNotAnHour) {
  SensorTimeline timeline;
  timeline.advance(10'000, {});
  timeline.advance(12'654, {});
  EXPECT_EQ(timeline.advance(11'327, {}), Step::kReordered);
  EXPECT_EQ(timeline.now(), sensor_time(12'654us));
  EXPECT_EQ(timeline.advance(13'981, {}), Step::kForward);
  EXPECT_EQ(timeline.now(), sensor_time(13'981us));
}

TEST(SensorTimeline, ReordersAcrossTheHour) {
  SensorTimeline timeline;
  timeline.advance(kHourUs - 2000, {});
  timeline.advance(500, {});
  EXPECT_EQ(timeline.advance(kHourUs - 700, {}), Step::kReordered);
  EXPECT_EQ(timeline.now(), sensor_time(1h + 500us));
  EXPECT_EQ(timeline.epoch(), 0U);
}

TEST(SensorTimeline, ARepeatedPacketIsReordered) {
  SensorTimeline timeline;
  timeline.advance(10'000, {});
  EXPECT_EQ(timeline.advance(10'000, {}), Step::kReordered);
}

TEST(SensorTimeline, AcceptedNmeaTimeStartsAnEpoch) {
  SensorTimeline timeline;
  timeline.advance(100'000'000, host_time(10s));
  EXPECT_EQ(timeline.advance(1'800'001'327, host_time(10s + 1327us)), Step::kJump);
  EXPECT_EQ(timeline.epoch(), 1U);
  EXPECT_EQ(timeline.now(), sensor_time(1'800'001'327us)) << "what the sensor says";
  EXPECT_EQ(timeline.advance(1'800'002'654, host_time(10s + 2654us)), Step::kForward);
}

TEST(SensorTimeline, ASetBackStartsAnEpoch) {
  SensorTimeline timeline;
  timeline.advance(1'800'000'000, host_time(10s));
  EXPECT_EQ(timeline.advance(1'799'000'000, host_time(10s + 1327us)), Step::kJump);
  EXPECT_EQ(timeline.epoch(), 1U);
}

TEST(SensorTimeline, TellsLossFromAJumpByTheHostsClock) {
  SensorTimeline loss;
  loss.advance(1'000'000, host_time(10s));
  EXPECT_EQ(loss.advance(6'000'000, host_time(15s)), Step::kForward) << "five seconds unplugged";
  SensorTimeline jump;
  jump.advance(1'000'000, host_time(10s));
  EXPECT_EQ(jump.advance(1'300'000, host_time(10s + 1327us)), Step::kJump) << "PPS moved it 0.3 s";
  SensorTimeline restarted;
  restarted.advance(1'000'000, host_time(10s));
  EXPECT_EQ(restarted.advance(4'000'000, host_time(50s)), Step::kJump);
}

TEST(SensorTimeline, LateArrivalsAreNoJump) {
  SensorTimeline timeline;
  timeline.advance(1'000'000, host_time(10s + 15ms));  // 15 ms late
  EXPECT_EQ(timeline.advance(1'013'270, host_time(10s + 15ms)), Step::kForward);
}

TEST(SensorTimeline, SmallSetBackIsNoticedWithinAFewPackets) {
  SensorTimeline timeline;
  timeline.advance(1'030'000, {});
  std::uint32_t stamp = 1'000'000;
  int left_out = 0;
  while (timeline.advance(stamp, {}) == Step::kReordered && left_out < 100) {
    stamp += 1327;
    ++left_out;
  }
  EXPECT_LT(left_out, 10) << "instead of thirty milliseconds of data";
  EXPECT_EQ(timeline.epoch(), 1U);
  EXPECT_EQ(timeline.now(), sensor_time(std::chrono::microseconds(stamp)));
}

TEST(SensorTimeline, PlacesAPositionPacketAmongTheData) {
  SensorTimeline timeline;
  timeline.advance(kHourUs - 500, host_time(10s));
  timeline.advance(827, host_time(10s + 1327us));
  EXPECT_EQ(timeline.place(900, host_time(10s + 1400us)), sensor_time(1h + 900us));
  EXPECT_EQ(timeline.place(kHourUs - 100, host_time(10s + 1400us)), sensor_time(1h - 100us))
      << "stamped before data that came before it";
  EXPECT_EQ(timeline.place(1'000'000'000, host_time(10s + 1400us)), std::nullopt)
      << "the clock was set";
  EXPECT_EQ(timeline.now(), sensor_time(1h + 827us));
}

TEST(SensorTimeline, PlacesPositionPacketsWhileNoDataCome) {
  SensorTimeline timeline;
  EXPECT_EQ(timeline.place(5'000'000, host_time(1s)), sensor_time(5s)) << "before the first";
  timeline.advance(6'000'000, host_time(2s));
  EXPECT_EQ(timeline.place(26'000'000, host_time(22s)), sensor_time(26s));
}

TEST(PacketsLost, ForgivesHalfAPacket) {
  EXPECT_EQ(packets_lost(1327us, 1327104ns), 0U);
  EXPECT_EQ(packets_lost(1328us, 1327104ns), 0U);
  EXPECT_EQ(packets_lost(1327us + 600us, 1327104ns), 0U) << "a step at a PPS edge";
  EXPECT_EQ(packets_lost(700us, 1327104ns), 0U);
  EXPECT_EQ(packets_lost(2654us, 1327104ns), 1U);
  EXPECT_EQ(packets_lost(13271us, 1327104ns), 9U);
  EXPECT_EQ(packets_lost(1327us, 663552ns), 1U) << "of dual packets";
}

// Whatever is lost or swapped on the way, the count is the true time.
RC_GTEST_PROP(SensorTimeline, CountsTrueTimeThroughLossAndReordering, ()) {
  const auto start_us = *rc::gen::inRange<std::int64_t>(0, kHourUs);
  const auto advances = *rc::gen::container<std::vector<int>>(rc::gen::inRange(-3, 6));
  SensorTimeline timeline;
  std::int64_t packet = 100;
  std::int64_t newest = packet;
  timeline.advance(static_cast<std::uint32_t>(start_us), host_time(100s));
  int behind = 0;
  for (const int advance : advances) {
    packet += advance;
    const std::int64_t since_us = (packet - 100) * 1327;
    const auto arrival = host_time(100s + std::max(packet - 100, newest - 100) * 1327us);
    const auto stamp = static_cast<std::uint32_t>((start_us + since_us + kHourUs) % kHourUs);
    const Step step = timeline.advance(stamp, arrival);
    behind = packet > newest ? 0 : behind + 1;
    if (behind >= 8 || packet < newest - 30) return;  // as good as a clock set back
    RC_ASSERT(step == (packet > newest ? Step::kForward : Step::kReordered));
    newest = std::max(newest, packet);
    RC_ASSERT(timeline.now() ==
              SensorTime(std::chrono::microseconds(start_us + (newest - 100) * 1327)));
  }
  RC_ASSERT(timeline.epoch() == 0U);
}

}  // namespace
}  // namespace sparsight
