#include "drivers/datasets/frame_times.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

HostTime at(std::chrono::nanoseconds since_start) { return HostTime(since_start); }

TEST(FrameTimes, AreSecondsInAnyNotation) {
  const auto times = parse_times_seconds("0.000000e+00\n1.041284e-01\r\n 0.25 \n\n\n", "times.txt");
  ASSERT_TRUE(times);
  EXPECT_THAT(*times, ::testing::ElementsAre(at(0ns), at(104'128'400ns), at(250ms)));
}

TEST(FrameTimes, OfAnEmptyFileAreNone) { EXPECT_THAT(*parse_times_seconds("", "f"), IsEmpty()); }

TEST(FrameTimes, RefuseWhatIsNoTimeByLine) {
  for (const std::string bad :
       {"x", "nan", "inf", "1e300", "-1e300", "0.1 0.2", "0,1", "", "0x1"}) {
    const auto times = parse_times_seconds("0\n" + bad + "\n1\n", "times.txt");
    ASSERT_FALSE(times) << bad;
    EXPECT_THAT(times.error().message, AllOf(HasSubstr("times.txt:2"), HasSubstr(bad)));
  }
}

TEST(FrameTimes, MustIncrease) {
  EXPECT_TRUE(require_increasing({at(0ns), at(1ns), at(5ns)}, "f"));
  EXPECT_THAT(require_increasing({at(0ns), at(5ns), at(1ns)}, "f").error().message,
              HasSubstr("f:3"));
  EXPECT_THAT(require_increasing({at(5ns), at(5ns)}, "f").error().message, HasSubstr("f:2"));
}

TEST(Timestamps, AreUtcWithNanoseconds) {
  const auto times = parse_timestamps_utc("1970-01-02 00:00:01.000000002\n", "f");
  ASSERT_TRUE(times);
  EXPECT_EQ((*times)[0], at(24h + 1s + 2ns));
}

TEST(Timestamps, MayHaveFewerOrMoreDigitsOrNone) {
  const auto times = parse_timestamps_utc(
      "1970-01-01 00:00:01\n1970-01-01 00:00:01.5\n1970-01-01 00:00:01.5000000019", "f");
  ASSERT_TRUE(times);
  EXPECT_THAT(*times, ::testing::ElementsAre(at(1s), at(1500ms), at(1500ms + 1ns)));
}

TEST(Timestamps, MayBeMissing) {
  const auto times = parse_timestamps_utc("\n1970-01-01 00:00:01\n\n1970-01-01 00:00:02\n\n", "f");
  ASSERT_TRUE(times);
  ASSERT_THAT(*times, SizeIs(4));
  EXPECT_FALSE((*times)[0]);
  EXPECT_FALSE((*times)[2]);
  EXPECT_EQ((*times)[3], at(2s));
}

TEST(Timestamps, RefuseWhatIsNoTimeByLine) {
  for (const std::string bad :
       {"2011-02-29 00:00:00", "2011-09-26 24:00:00", "2011-09-26 13:60:00", "2011-09-26 13:00:61",
        "2011-09-26T13:00:00", "2011-09-26 13:00:00,5", "2011-09-26 13:00:00.5x", "2011-09-26",
        "2011-09-26 13:00:00.-5", "0011-09-26 13:00:00", "9999-09-26 13:00:00",
        "2011-9-26 13:00:00", "2011-13-26 13:00:00", "x"}) {
    const auto times = parse_timestamps_utc("1970-01-01 00:00:01\n" + bad + "\n", "f");
    ASSERT_FALSE(times) << bad;
    EXPECT_THAT(times.error().message, AllOf(HasSubstr("f:2"), HasSubstr(bad)));
  }
}

RC_GTEST_PROP(Timestamps, SurvivePrintingToTheNanosecond, ()) {
  const auto ns = *rc::gen::inRange<std::int64_t>(0, 4'000'000'000'000'000'000);
  const std::chrono::sys_time<std::chrono::nanoseconds> time{std::chrono::nanoseconds(ns)};
  const auto day = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss clock(time - day);
  const std::string line =
      fmt::format("{:04}-{:02}-{:02} {:02}:{:02}:{:02}.{:09}", int(date.year()),
                  unsigned(date.month()), unsigned(date.day()), clock.hours().count(),
                  clock.minutes().count(), clock.seconds().count(), clock.subseconds().count());
  const auto times = parse_timestamps_utc(line, "f");
  RC_ASSERT(times.has_value());
  RC_ASSERT((*times)[0]->time_since_epoch().count() == ns);
}

}  // namespace
}  // namespace sparsight
