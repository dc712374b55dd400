#include "drivers/gpio/gpio_trigger_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/drivers/gpio/fake_gpio.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr unsigned kExposure = 17;
constexpr unsigned kPps = 27;
constexpr std::chrono::nanoseconds kFrame = 33'333'333ns;

class GpioTriggerLineTest : public ::testing::Test {
 protected:
  void start() {
    line_ = std::make_unique<GpioTriggerLine>(config_, gpio_);
    const auto started = line_->start();
    ASSERT_TRUE(started) << started.error().message;
  }
  std::vector<Edge> read_all(std::chrono::nanoseconds patience = 100ms) {
    std::vector<Edge> edges;
    while (auto edge = line_->read(patience)) edges.push_back(*edge);
    return edges;
  }
  std::string refusal(int watch_errno) {
    gpio_.watch_errno = watch_errno;
    GpioTriggerLine line(config_, gpio_);
    const auto started = line.start();
    return started ? "none" : started.error().message;
  }

  testing::FakeGpio gpio_;
  TriggerConfig config_{.chip = "/dev/gpiochip4", .exposure_line = kExposure};
  std::unique_ptr<GpioTriggerLine> line_;
};

TEST_F(GpioTriggerLineTest, BothEdgesOfAnExposureComeWithTheKernelsTimes) {
  gpio_.add_pulses(kExposure, 3, kFrame, 4ms);
  const auto expected = gpio_.lines[kExposure].to_come;
  start();
  EXPECT_EQ(gpio_.chip, "/dev/gpiochip4");
  const auto edges = read_all();
  ASSERT_EQ(edges.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(edges[i].line, EdgeLine::kExposure);
    EXPECT_EQ(edges[i].rising, i % 2 == 0);
    EXPECT_EQ(edges[i].time, expected[i].time);
  }
  EXPECT_EQ(line_->counters().edges, 6U);
  EXPECT_EQ(line_->counters().repeated, 0U);
  EXPECT_EQ(line_->counters().full_reads, 0U);
}

TEST_F(GpioTriggerLineTest, AShortTriggerPulseGivesItsOneEdge) {
  config_.exposure_active = false;
  gpio_.add_pulses(kExposure, 3, kFrame, 10us);
  start();
  EXPECT_EQ(gpio_.lines[kExposure].edges, WatchedEdges::kRising);
  EXPECT_EQ(read_all().size(), 3U);
  EXPECT_EQ(line_->counters().repeated, 0U) << "one edge always repeats";
}

TEST_F(GpioTriggerLineTest, PolarityIsTheExposureLinesOnly) {
  config_.active_low = true;
  config_.pps_line = kPps;
  start();
  EXPECT_TRUE(gpio_.lines[kExposure].active_low);
  EXPECT_FALSE(gpio_.lines[kPps].active_low);
  EXPECT_EQ(gpio_.lines[kPps].edges, WatchedEdges::kRising);
}

TEST_F(GpioTriggerLineTest, ALostEdgeShowsAsARepeatedOne) {
  gpio_.add_pulses(kExposure, 3, kFrame, 4ms);
  auto& edges = gpio_.lines[kExposure].to_come;
  edges.erase(edges.begin() + 2);
  start();
  EXPECT_EQ(read_all().size(), 5U);
  EXPECT_EQ(line_->counters().repeated, 1U);
}

TEST_F(GpioTriggerLineTest, AStallThatFillsTheKernelsQueueIsCounted) {
  gpio_.add_pulses(kExposure, 20, 10ms, 4ms);
  start();
  gpio_.sleep(190ms);  // 37 edges, of which the kernel keeps 16
  const auto edges = read_all();
  EXPECT_EQ(edges.size(), 16U + 3U);
  EXPECT_EQ(line_->counters().full_reads, 1U);
  EXPECT_EQ(gpio_.lines[kExposure].dropped, 21U);
}

TEST_F(GpioTriggerLineTest, TwoLinesAreMergedInTheOrderOfTheirTimes) {
  config_.pps_line = kPps;
  gpio_.add_pulses(kExposure, 95, kFrame, 4ms);
  gpio_.add_pulses(kPps, 3, 1s, 50ms);
  start();
  const auto edges = read_all(2s);
  EXPECT_EQ(edges.size(), 2U * 95U + 3U);
  int pulses = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i > 0) {
      EXPECT_GE(edges[i].time, edges[i - 1].time);
    }
    pulses += edges[i].line == EdgeLine::kPps ? 1 : 0;
  }
  EXPECT_EQ(pulses, 3);
}

TEST_F(GpioTriggerLineTest, AnEdgeThatIsQueuedAfterALaterOneOfTheOtherLineStillComesFirst) {
  config_.pps_line = kPps;
  const HostTime begin = gpio_.clock;
  gpio_.lines[kExposure].to_come = {{true, begin + 10ms + 100us}};
  gpio_.lines[kPps].to_come = {{true, begin + 10ms}};
  gpio_.lines[kPps].queued_after = 300us;
  start();
  const auto edges = read_all();
  ASSERT_EQ(edges.size(), 2U);
  EXPECT_EQ(edges[0].line, EdgeLine::kPps);
  EXPECT_EQ(edges[1].line, EdgeLine::kExposure);
}

TEST_F(GpioTriggerLineTest, AnEdgeThatComesFarTooLateIsLeftOutRatherThanOutOfOrder) {
  config_.pps_line = kPps;
  const HostTime begin = gpio_.clock;
  gpio_.lines[kExposure].to_come = {{true, begin + 11ms}};
  gpio_.lines[kPps].to_come = {{true, begin + 10ms}};
  gpio_.lines[kPps].queued_after = 20ms;
  start();
  EXPECT_EQ(read_all().size(), 1U);
  EXPECT_EQ(line_->counters().edges, 1U);
  EXPECT_THAT(line_->last_fault(), HasSubstr("came after a later one"));
}

TEST_F(GpioTriggerLineTest, OneLineIsNotHeldBack) {
  gpio_.add_pulses(kExposure, 1, 10ms, 4ms);
  start();
  const auto edge = line_->read(1s);
  ASSERT_TRUE(edge);
  EXPECT_EQ(gpio_.clock, edge->time);
}

TEST_F(GpioTriggerLineTest, StampsOfTheTimeOfDayAreRefused) {
  gpio_.lines[kExposure].to_come = {{true, gpio_.clock + 10ms}};
  start();
  gpio_.sleep(10ms);
  gpio_.lines[kExposure].queue.front().time += std::chrono::hours(24 * 365 * 50);
  EXPECT_FALSE(line_->read(100ms));
  EXPECT_THAT(line_->last_fault(), HasSubstr("Linux 5.7 or newer"));
}

TEST_F(GpioTriggerLineTest, ASecondWithoutEdgesIsSilence) {
  start();
  EXPECT_FALSE(line_->read(900ms));
  EXPECT_EQ(line_->state(), DeviceState::kStreaming);
  EXPECT_FALSE(line_->read(200ms));
  EXPECT_EQ(line_->state(), DeviceState::kSilent);
  gpio_.add_pulses(kExposure, 1, 10ms, 4ms);
  EXPECT_TRUE(line_->read(100ms));
  EXPECT_EQ(line_->state(), DeviceState::kStreaming);
}

TEST_F(GpioTriggerLineTest, AChipThatGoesAwayIsLookedForAgain) {
  start();
  gpio_.read_errno = ENODEV;
  gpio_.watch_errno = ENOENT;
  EXPECT_FALSE(line_->read(1s));
  EXPECT_EQ(line_->state(), DeviceState::kGone);
  EXPECT_EQ(gpio_.watched, 0);
  EXPECT_GE(gpio_.attempts.size(), 4U);
  EXPECT_LE(gpio_.attempts.size(), 8U);
  gpio_.read_errno = 0;
  gpio_.watch_errno = 0;
  gpio_.add_pulses(kExposure, 10, 50ms, 4ms);
  EXPECT_TRUE(line_->read(1s));
  EXPECT_EQ(line_->state(), DeviceState::kStreaming);
}

TEST_F(GpioTriggerLineTest, ErrorsNameChipLineAndFix) {
  EXPECT_EQ(refusal(EBUSY),
            "/dev/gpiochip4: cannot watch line 17 ([trigger] exposure_line): Device or resource "
            "busy; another program or driver has the line: gpioinfo says which");
  EXPECT_THAT(refusal(ENOENT), HasSubstr("gpiodetect"));
  EXPECT_THAT(refusal(EACCES), HasSubstr("group"));
  EXPECT_EQ(gpio_.watched, 0);
}

TEST(LibgpiodCalls, AnAbsentChipIsSaidToBeAbsent) {
  EXPECT_EQ(libgpiod_calls().watch("/dev/no_such_gpiochip", 0, WatchedEdges::kBoth, false),
            -ENOENT);
}

}  // namespace
}  // namespace sparsight
