#include "drivers/vlp16/position_packet.h"

#include <gtest/gtest.h>

#include "drivers/vlp16/packet_writer.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;

// 18 minutes and 2 seconds past eight.
constexpr auto kAt1802 = "$GPRMC,081802.00,A,3649.74,N,00224.45,W,0.0,212.5,210116,0.0,E*46";

PositionReading position_of(std::uint32_t microseconds, PpsState pps, const char* gprmc) {
  const auto reading = read_position_packet(write_position_packet(microseconds, pps, gprmc));
  EXPECT_TRUE(reading);
  return reading.value_or(PositionReading{});
}

TEST(PositionPacket, ReadsStampStateAndSentence) {
  const PositionReading reading = position_of(1'082'342'001, PpsState::kSynchronizing, kAt1802);
  EXPECT_EQ(reading.microseconds_past_hour, 1'082'342'001U);
  EXPECT_EQ(reading.pps, PpsState::kSynchronizing);
  ASSERT_TRUE(reading.gprmc);
  EXPECT_EQ(reading.gprmc->time_of_day, 8h + 18min + 2s);
}

TEST(PositionPacket, RefusesAPpsStateThatThereIsNot) {
  auto bytes = write_position_packet(0, PpsState::kError, "");
  EXPECT_TRUE(read_position_packet(bytes));
  bytes[202] = 4;
  EXPECT_FALSE(read_position_packet(bytes));
}

TEST(PositionPacket, SurvivesASentenceWithoutEnd) {
  auto bytes = write_position_packet(0, PpsState::kLocked, kAt1802);
  std::fill(bytes.begin() + 206, bytes.end(), std::uint8_t{'$'});
  const auto reading = read_position_packet(bytes);
  ASSERT_TRUE(reading);
  EXPECT_FALSE(reading->gprmc);
}

TEST(PositionPacket, HourIsUtcWhenLockedAndTheSentenceAgrees) {
  EXPECT_TRUE(hour_is_utc(position_of(1'082'342'001, PpsState::kLocked, kAt1802)));
  EXPECT_TRUE(hour_is_utc(position_of(1'083'900'000, PpsState::kLocked, kAt1802)));
  EXPECT_TRUE(hour_is_utc(position_of(1'081'500'000, PpsState::kLocked, kAt1802)));
}

TEST(PositionPacket, HourIsNotUtcWithoutLockOrSentence) {
  EXPECT_FALSE(hour_is_utc(position_of(1'082'342'001, PpsState::kSynchronizing, kAt1802)));
  EXPECT_FALSE(hour_is_utc(position_of(1'082'342'001, PpsState::kAbsent, kAt1802)));
  EXPECT_FALSE(hour_is_utc(position_of(1'082'342'001, PpsState::kLocked, "")));
  EXPECT_FALSE(hour_is_utc(position_of(0, PpsState::kLocked, "$GPRMC,000000,V,,,,,,,010100,,*31")));
}

TEST(PositionPacket, HourIsNotUtcWhenTheSensorRunsFreely) {
  // Seventeen minutes off, as users of other drivers saw.
  EXPECT_FALSE(hour_is_utc(position_of(62'342'001, PpsState::kLocked, kAt1802)));
  EXPECT_FALSE(hour_is_utc(position_of(1'087'000'000, PpsState::kLocked, kAt1802)));
  EXPECT_FALSE(hour_is_utc(position_of(1'079'000'000, PpsState::kLocked, kAt1802)));
}

TEST(PositionPacket, HoursTurnBetweenSentenceAndStamp) {
  constexpr auto kMidnight = "$GPRMC,000000,A,,,,,,,010100,,*26";
  EXPECT_TRUE(hour_is_utc(position_of(300'000, PpsState::kLocked, kMidnight)));
  EXPECT_TRUE(hour_is_utc(position_of(3'599'800'000, PpsState::kLocked, kMidnight)));
  EXPECT_TRUE(hour_is_utc(position_of(3'600'300'000, PpsState::kLocked, kMidnight)));
}

}  // namespace
}  // namespace sparsight
