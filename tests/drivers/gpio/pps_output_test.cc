#include "drivers/gpio/pps_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>
#include <vector>

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

struct PortLog {
  struct Entry {
    HostTime at;
    std::string what;  // "high", "low", or the sentence
  };
  std::vector<Entry> entries;
  HostTime clock{1000s};
  std::chrono::nanoseconds oversleep{0};  // once
  bool takes_sentences = true;
  bool open = false;
};

constexpr std::chrono::nanoseconds kUtcOffset = 1'700'000'000s + 300ms;  // UTC minus host time

class FakePort final : public PpsPort {
 public:
  explicit FakePort(PortLog& log) : log_(log) {}
  Result<void> open(const TriggerConfig&) override {
    log_.open = true;
    return {};
  }
  void close() override {
    log_.entries.push_back({log_.clock, "low"});
    log_.open = false;
  }
  bool set_pin(bool high) override {
    log_.entries.push_back({log_.clock, high ? "high" : "low"});
    return true;
  }
  bool send(std::string_view sentence) override {
    log_.entries.push_back({log_.clock, std::string(sentence)});
    return log_.takes_sentences;
  }
  void sleep_until(HostTime time) override {
    log_.clock = std::max(log_.clock, time) + std::exchange(log_.oversleep, 0ns);
  }
  HostTime now() override { return log_.clock; }
  std::chrono::sys_time<std::chrono::nanoseconds> utc_now() override {
    return std::chrono::sys_time<std::chrono::nanoseconds>(log_.clock.time_since_epoch() +
                                                           kUtcOffset);
  }

 private:
  PortLog& log_;
};

class PpsOutputTest : public ::testing::Test {
 protected:
  void step(int count) {
    for (int i = 0; i < count; ++i) output_.step();
  }
  std::vector<PortLog::Entry> logged(std::string_view what) const {
    std::vector<PortLog::Entry> found;
    for (const auto& entry : log_.entries) {
      if (entry.what.starts_with(what)) found.push_back(entry);
    }
    return found;
  }

  PortLog log_;
  PpsOutput output_{{.pps_output_line = 22, .nmea_device = "/dev/ttyS1"},
                    std::make_unique<FakePort>(log_)};
};

TEST_F(PpsOutputTest, PulsesBeginWithTheSecondsOfUtcAndLastFiftyMilliseconds) {
  ASSERT_TRUE(output_.start());
  step(30);
  const auto rises = logged("high");
  const auto falls = logged("low");
  ASSERT_EQ(rises.size(), 10U);
  ASSERT_EQ(falls.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ((rises[i].at.time_since_epoch() + kUtcOffset) % 1s, 0ns);
    EXPECT_EQ(falls[i].at - rises[i].at, 50ms);
    if (i > 0) {
      EXPECT_EQ(rises[i].at - rises[i - 1].at, 1s);
    }
  }
  EXPECT_EQ(output_.counters().pulses, 10U);
}

TEST_F(PpsOutputTest, TheSentenceNamesTheSecondThatBeganAtTheEdgeBeforeIt) {
  ASSERT_TRUE(output_.start());
  step(30);
  const auto rises = logged("high");
  const auto sentences = logged("$GPRMC");
  ASSERT_EQ(sentences.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_GE(sentences[i].at - rises[i].at, 150ms);
    EXPECT_LE(sentences[i].at - rises[i].at, 250ms);
    const auto utc = rises[i].at.time_since_epoch() + kUtcOffset;
    EXPECT_EQ(sentences[i].what, gprmc(UtcSecond(std::chrono::floor<std::chrono::seconds>(utc))));
  }
}

TEST_F(PpsOutputTest, ALateWakeUpLeavesThePulseOutAndKeepsThePhase) {
  ASSERT_TRUE(output_.start());
  step(3);
  log_.oversleep = 20ms;
  step(1);
  step(3);
  const auto rises = logged("high");
  ASSERT_EQ(rises.size(), 2U);
  EXPECT_EQ(rises[1].at - rises[0].at, 2s);
  EXPECT_EQ(output_.counters().late, 1U);
  const auto utc = rises[1].at.time_since_epoch() + kUtcOffset;
  EXPECT_EQ(logged("$GPRMC").back().what,
            gprmc(UtcSecond(std::chrono::floor<std::chrono::seconds>(utc))));
}

TEST_F(PpsOutputTest, ASmallDelayIsMeasuredAndNotCarriedOn) {
  ASSERT_TRUE(output_.start());
  log_.oversleep = 1ms;
  step(6);
  const auto rises = logged("high");
  EXPECT_EQ(rises[1].at - rises[0].at, 999ms);
  EXPECT_EQ(output_.counters().worst_delay, 1ms);
}

TEST_F(PpsOutputTest, ALateSentenceIsLeftOutAsItWouldNameTheWrongSecond) {
  ASSERT_TRUE(output_.start());
  step(2);
  log_.oversleep = 60ms;
  step(1);
  EXPECT_TRUE(logged("$GPRMC").empty());
  EXPECT_EQ(output_.counters().late, 1U);
  step(3);
  EXPECT_EQ(logged("$GPRMC").size(), 1U);
}

TEST_F(PpsOutputTest, ASerialPortThatTakesNothingDoesNotHoldThePulseUp) {
  log_.takes_sentences = false;
  ASSERT_TRUE(output_.start());
  step(9);
  EXPECT_EQ(logged("high").size(), 3U);
  EXPECT_EQ(logged("low").size(), 3U);
  EXPECT_EQ(output_.counters().failed, 3U);
}

TEST_F(PpsOutputTest, ThePinIsLowWhenItStops) {
  ASSERT_TRUE(output_.start());
  step(1);
  output_.stop();
  EXPECT_EQ(log_.entries.back().what, "low");
  EXPECT_FALSE(log_.open);
  output_.step();
  EXPECT_EQ(log_.entries.back().what, "low") << "a stopped output does nothing";
}

TEST(PpsOutput, WithoutALineItSaysWhichKeyIsMissing) {
  PpsOutput output(TriggerConfig{});
  const auto started = output.start();
  ASSERT_FALSE(started);
  EXPECT_THAT(started.error().message, HasSubstr("[trigger] pps_output_line: missing"));
}

TEST(PpsPlan, EveryEdgeIsAWholeNumberOfSecondsFromTheFirstWhateverIsSkipped) {
  EXPECT_TRUE(rc::check([] {
    const HostTime first(5s);
    PpsPlan plan(first, UtcSecond(100s));
    HostTime now = first;
    UtcSecond named{};
    for (int i = 0; i < 50; ++i) {
      const PpsStep step = plan.next();
      now = std::max(now, step.at) + std::chrono::milliseconds(*rc::gen::inRange(0, 1500));
      if (step.kind == PpsStep::Kind::kRise) {
        RC_ASSERT((step.at - first) % 1s == 0ns);
        RC_ASSERT(step.second - UtcSecond(100s) == step.at - first);
        RC_ASSERT(step.second > named);
        named = step.second;
      }
      if (*rc::gen::inRange(0, 4) == 0) {
        plan.done();
        plan.skip_to(now);
      } else {
        plan.done();
      }
    }
  }));
}

}  // namespace
}  // namespace sparsight
