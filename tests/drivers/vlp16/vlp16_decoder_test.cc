#include "drivers/vlp16/vlp16_decoder.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/drivers/vlp16/made_packets.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using testing::MadePacket;
using testing::packet_of;

constexpr std::uint32_t kHourMicroseconds = 3'600'000'000U;

DecodedPacket decoded(const MadePacket& made, const LidarConfig& config = {}) {
  Vlp16Decoder decoder(config);
  DecodedPacket out;
  EXPECT_TRUE(decoder.decode(packet_of(made), out));
  return out;
}

TEST(Vlp16Decoder, EqualsWhatTheManualGivesByHand) {
  const DecodedPacket out =
      decoded({.first_azimuth_centideg = 10000, .microseconds_past_hour = 1'000'000});
  ASSERT_EQ(out.returns.size(), 384U);
  EXPECT_EQ(out.first_firing, SensorTime(1s));
  EXPECT_EQ(out.last_firing, SensorTime(1s + 1'306'368ns));
  EXPECT_NEAR(out.first_azimuth_deg, 100.0, 1e-9);
  EXPECT_NEAR(out.turned_deg, 4.8, 1e-9);
  // Channel 17 of block 0: the second sequence's laser 1, one degree up, 57.6 us on.
  const TimedReturn& early = out.returns[17];
  EXPECT_EQ(early.fired, SensorTime(1s + 57'600ns));
  EXPECT_EQ(early.ring, 8);
  EXPECT_EQ(early.intensity, 10.0F);
  EXPECT_NEAR(early.azimuth_deg, 100.208333, 1e-4);
  EXPECT_NEAR(early.p_lidar.x(), -1.772009, 2e-6);
  EXPECT_NEAR(early.p_lidar.y(), -9.840199, 2e-6);
  EXPECT_NEAR(early.p_lidar.z(), 0.173824, 2e-6);
  // Channel 31 of block 11, the last of all: laser 15, fifteen degrees up.
  const TimedReturn& last = out.returns.back();
  EXPECT_EQ(last.fired, out.last_firing);
  EXPECT_EQ(last.ring, 15);
  EXPECT_NEAR(last.azimuth_deg, 104.725, 1e-4);
  EXPECT_NEAR(last.p_lidar.x(), -2.455190, 2e-6);
  EXPECT_NEAR(last.p_lidar.y(), -9.342019, 2e-6);
  EXPECT_NEAR(last.p_lidar.z(), 2.576990, 2e-6);
}

TEST(Vlp16Decoder, LooksAheadAlongXAndTurnsClockwise) {
  const MadePacket still{.block_gap_centideg = 0, .distance_2mm = 2000};
  MadePacket right = still;
  right.first_azimuth_centideg = 9000;
  EXPECT_TRUE(
      decoded(still).returns[0].p_lidar.isApprox(Eigen::Vector3f(3.863703F, 0, -1.024076F), 1e-6F));
  EXPECT_TRUE(decoded(right).returns[0].p_lidar.isApprox(Eigen::Vector3f(0, -3.863703F, -1.024076F),
                                                         1e-6F));
}

TEST(Vlp16Decoder, AddsTheVerticalOffsetToHeightOnly) {
  LidarConfig without;
  without.vertical_offset_mm.emplace();
  const DecodedPacket with_offset = decoded({});
  const DecodedPacket without_offset = decoded({}, without);
  for (std::size_t i = 0; i < 16; ++i) {
    const Eigen::Vector3f difference =
        with_offset.returns[i].p_lidar - without_offset.returns[i].p_lidar;
    EXPECT_EQ(difference.x(), 0.0F);
    EXPECT_EQ(difference.y(), 0.0F);
    EXPECT_NEAR(difference.z(), 1e-3 * kVlp16LaserTable[i].vertical_offset_mm, 1e-6);
  }
  EXPECT_NEAR(with_offset.returns[0].p_lidar.z() - without_offset.returns[0].p_lidar.z(), 0.0112,
              1e-6);
}

TEST(Vlp16Decoder, TakesItsLasersFromTheConfiguration) {
  LidarConfig config;
  config.elevation_deg.emplace();
  config.vertical_offset_mm.emplace();
  config.elevation_deg->fill(0.0);
  (*config.elevation_deg)[8] = 30.0;  // by ring: the laser that fires second
  const DecodedPacket out = decoded({.block_gap_centideg = 0}, config);
  EXPECT_NEAR(out.returns[0].p_lidar.z(), 0.0, 1e-6);
  EXPECT_NEAR(out.returns[1].p_lidar.z(), 5.0, 1e-6);
}

TEST(Vlp16Decoder, ReadsTheHiResByItsOwnTable) {
  MadePacket made{.block_gap_centideg = 0};
  LidarPacket packet = packet_of(made);
  packet.payload[1205] = 0x24;
  Vlp16Decoder decoder;
  DecodedPacket out;
  ASSERT_TRUE(decoder.decode(packet, out));
  EXPECT_NEAR(out.returns[0].p_lidar.z(), -1.7365 + 0.0074, 1e-4) << "ten degrees down";
  EXPECT_NEAR(out.returns[15].p_lidar.z(), 1.7365 - 0.0074, 1e-4);
}

TEST(Vlp16Decoder, LeavesOutWhatIsNoReturnOrOutOfRange) {
  LidarConfig config;
  config.min_range_m = 1.0;
  config.max_range_m = 100.0;
  EXPECT_EQ(decoded({.distance_2mm = 0}, config).returns.size(), 0U);
  EXPECT_EQ(decoded({.distance_2mm = 499}, config).returns.size(), 0U);
  EXPECT_EQ(decoded({.distance_2mm = 500}, config).returns.size(), 384U);
  EXPECT_EQ(decoded({.distance_2mm = 50000}, config).returns.size(), 384U);
  EXPECT_EQ(decoded({.distance_2mm = 50001}, config).returns.size(), 0U);
  config.min_range_m = 0.0;
  EXPECT_EQ(decoded({.distance_2mm = 0}, config).returns.size(), 0U);
}

TEST(Vlp16Decoder, GivesBothReturnsOfADualFiringTheSameTime) {
  const DecodedPacket out = decoded({.mode = ReturnMode::kDual, .second_distance_2mm = 2500});
  ASSERT_EQ(out.returns.size(), 384U);
  EXPECT_EQ(out.last_firing - out.first_firing, 11 * 55'296ns + 15 * 2'304ns);
  for (std::size_t i = 0; i < out.returns.size(); i += 2) {
    EXPECT_EQ(out.returns[i].fired, out.returns[i + 1].fired);
    EXPECT_EQ(out.returns[i].ring, out.returns[i + 1].ring);
    EXPECT_NEAR(out.returns[i].p_lidar.head<2>().norm(),
                2 * out.returns[i + 1].p_lidar.head<2>().norm(), 1e-4);
  }
  EXPECT_EQ(out.returns[32].fired - out.first_firing, 55'296ns);
}

TEST(Vlp16Decoder, GivesALoneReturnOfADualFiringOnce) {
  EXPECT_EQ(decoded({.mode = ReturnMode::kDual}).returns.size(), 192U);
  EXPECT_EQ(decoded({.mode = ReturnMode::kDual, .distance_2mm = 0}).returns.size(), 192U);
}

TEST(Vlp16Decoder, CountsRefusedPacketsAndSaysWhy) {
  Vlp16Decoder decoder;
  DecodedPacket out;
  LidarPacket packet = packet_of({});
  packet.payload[1205] = 0x28;
  EXPECT_FALSE(decoder.decode(packet, out));
  EXPECT_EQ(decoder.counters().refused, 1U);
  EXPECT_EQ(decoder.last_fault(), PacketFault::kProduct);
}

TEST(Vlp16Decoder, CountsLossByTheTimeThatIsMissing) {
  Vlp16Decoder decoder;
  DecodedPacket out;
  ASSERT_TRUE(decoder.decode(packet_of({.microseconds_past_hour = 0}), out));
  ASSERT_TRUE(decoder.decode(packet_of({.microseconds_past_hour = 1328}), out));
  EXPECT_EQ(out.lost_before, 0U);
  ASSERT_TRUE(decoder.decode(packet_of({.microseconds_past_hour = 5308}), out));
  EXPECT_EQ(out.lost_before, 2U);
  EXPECT_EQ(decoder.counters().lost, 2U);
}

TEST(Vlp16Decoder, CountsLossOfDualPacketsByTheirOwnLength) {
  Vlp16Decoder decoder;
  DecodedPacket out;
  ASSERT_TRUE(decoder.decode(packet_of({.mode = ReturnMode::kDual}), out));
  ASSERT_TRUE(
      decoder.decode(packet_of({.microseconds_past_hour = 1327, .mode = ReturnMode::kDual}), out));
  EXPECT_EQ(out.lost_before, 1U);
}

TEST(Vlp16Decoder, LeavesOutReorderedPackets) {
  Vlp16Decoder decoder;
  DecodedPacket out;
  ASSERT_TRUE(decoder.decode(packet_of({.microseconds_past_hour = 10'000}), out));
  EXPECT_FALSE(decoder.decode(packet_of({.microseconds_past_hour = 8'673}), out));
  ASSERT_TRUE(decoder.decode(packet_of({.microseconds_past_hour = 11'327}), out));
  EXPECT_EQ(out.lost_before, 0U);
  EXPECT_EQ(out.epoch, 0U);
  EXPECT_EQ(decoder.counters().reordered, 1U);
  EXPECT_EQ(decoder.counters().decoded, 2U);
}

TEST(Vlp16Decoder, CountsOnOverTheHour) {
  Vlp16Decoder decoder;
  DecodedPacket out;
  ASSERT_TRUE(decoder.decode(packet_of({.microseconds_past_hour = kHourMicroseconds - 327}), out));
  EXPECT_EQ(out.last_firing, SensorTime(1h - 327us + 1'306'368ns));
  ASSERT_TRUE(decoder.decode(packet_of({.microseconds_past_hour = 1000}), out));
  EXPECT_EQ(out.first_firing, SensorTime(1h + 1000us));
  EXPECT_EQ(decoder.counters().clock_jumps, 0U);
}

TEST(Vlp16Decoder, ClockJumpStartsAnEpochWithoutInventedLoss) {
  Vlp16Decoder decoder;
  DecodedPacket out;
  const HostTime now(100s);
  ASSERT_TRUE(decoder.decode(packet_of({.microseconds_past_hour = 0}, now), out));
  ASSERT_TRUE(
      decoder.decode(packet_of({.microseconds_past_hour = 1'500'000'000}, now + 1327us), out));
  EXPECT_EQ(out.epoch, 1U);
  EXPECT_EQ(out.lost_before, 0U);
  EXPECT_EQ(decoder.counters().clock_jumps, 1U);
  EXPECT_EQ(decoder.counters().lost, 0U);
}

TEST(Vlp16Decoder, ReportsTheClockOnTheSameCountAsTheData) {
  Vlp16Decoder decoder;
  DecodedPacket out;
  const HostTime now(100s);
  decoder.decode(packet_of({.microseconds_past_hour = kHourMicroseconds - 100}, now), out);
  decoder.decode(packet_of({.microseconds_past_hour = 1227}, now + 1327us), out);
  constexpr auto kMidnight = "$GPRMC,000000,A,,,,,,,010100,,*26";
  const PositionPacket position{now + 1500us,
                                write_position_packet(1400, PpsState::kLocked, kMidnight)};
  const auto report = decoder.decode(position);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->time, SensorTime(1h + 1400us));
  EXPECT_EQ(report->arrival, now + 1500us);
  EXPECT_EQ(report->pps, PpsState::kLocked);
  EXPECT_TRUE(report->utc_valid);
}

TEST(Vlp16Decoder, RefusesPositionPacketsThatAreNone) {
  Vlp16Decoder decoder;
  PositionPacket position;
  position.payload[202] = 9;
  EXPECT_FALSE(decoder.decode(position));
  EXPECT_EQ(decoder.counters().refused, 1U);
}

TEST(Vlp16Decoder, DoesNotAllocateAgainOnceGrown) {
  Vlp16Decoder decoder;
  DecodedPacket out;
  decoder.decode(packet_of({.distance_2mm = 0}), out);
  const std::size_t capacity = out.returns.capacity();
  decoder.decode(packet_of({.microseconds_past_hour = 1327}), out);
  decoder.decode(
      packet_of(
          {.microseconds_past_hour = 2654, .mode = ReturnMode::kDual, .second_distance_2mm = 2500}),
      out);
  EXPECT_EQ(out.returns.capacity(), capacity);
}

RC_GTEST_PROP(Vlp16Decoder, EveryReturnIsWhereItsRangeAndAnglesSay, ()) {
  const MadePacket made{
      .first_azimuth_centideg = *rc::gen::inRange(0, 36000),
      .block_gap_centideg = *rc::gen::inRange(15, 81),
      .microseconds_past_hour = *rc::gen::inRange<std::uint32_t>(0, kHourMicroseconds),
      .distance_2mm = *rc::gen::inRange<std::uint16_t>(300, 50000)};
  const DecodedPacket out = decoded(made);
  RC_ASSERT(out.returns.size() == 384U);
  SensorTime before = out.first_firing - 1ns;
  for (std::size_t i = 0; i < out.returns.size(); ++i) {
    const TimedReturn& point = out.returns[i];
    RC_ASSERT(point.azimuth_deg >= 0.0F && point.azimuth_deg < 360.0F);
    RC_ASSERT(point.fired > before && point.fired <= out.last_firing);
    before = point.fired;
    const LaserPlacement& laser = kVlp16LaserTable[i % kVlp16Lasers];
    RC_ASSERT(point.ring == laser.ring);
    const double azimuth = point.azimuth_deg * M_PI / 180;
    const double elevation = laser.elevation_deg * M_PI / 180;
    const double range = made.distance_2mm * 0.002;
    const Eigen::Vector3d expected(range * std::cos(elevation) * std::cos(azimuth),
                                   -range * std::cos(elevation) * std::sin(azimuth),
                                   range * std::sin(elevation) + laser.vertical_offset_mm * 1e-3);
    RC_ASSERT((point.p_lidar.cast<double>() - expected).norm() < 1e-4);
  }
}

}  // namespace
}  // namespace sparsight
