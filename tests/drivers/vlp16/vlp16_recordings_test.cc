#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>

#include "drivers/vlp16/sweep_assembler.h"
#include "drivers/vlp16/vlp16_decoder.h"
#include "tests/build_paths.h"

// A real sensor's packets, single return, 1.33 s at about 10 revolutions per second.
namespace sparsight {
namespace {

using namespace std::chrono_literals;

std::vector<LidarPacket> recorded_packets() {
  std::ifstream file(testing::recordings() / "vlp16/packets_1000.bin", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  std::vector<LidarPacket> packets(bytes.size() / 1206);
  HostTime arrival(10s);
  for (std::size_t i = 0; i < packets.size(); ++i) {
    std::memcpy(packets[i].payload.data(), bytes.data() + 1206 * i, 1206);
    packets[i].arrival = arrival;
    arrival += 1327us;
  }
  return packets;
}

double degrees_on(double from, double to) { return std::remainder(to - from, 360.0); }

TEST(Vlp16Recording, DecodesWithoutRefusalOrLoss) {
  const auto packets = recorded_packets();
  if (packets.empty()) GTEST_SKIP() << "no recording (SPARSIGHT_DATA)";
  ASSERT_EQ(packets.size(), 1000U);
  Vlp16Decoder decoder;
  DecodedPacket out;
  SensorTime first;
  double turned = 0.0;
  std::size_t returns = 0;
  for (const LidarPacket& packet : packets) {
    ASSERT_TRUE(decoder.decode(packet, out));
    if (first == SensorTime{}) first = out.first_firing;
    turned += out.turned_deg;
    returns += out.returns.size();
  }
  EXPECT_EQ(decoder.counters().decoded, 1000U);
  EXPECT_EQ(decoder.counters().refused, 0U);
  EXPECT_EQ(decoder.counters().lost, 0U);
  EXPECT_EQ(decoder.counters().clock_jumps, 0U);
  EXPECT_NEAR(to_seconds(out.last_firing - first), 1.327, 0.001);
  EXPECT_NEAR(turned / 360.0, 13.2, 0.3);
  EXPECT_GT(returns, 100'000U);
}

TEST(Vlp16Recording, AzimuthAndTimeGrowFromFiringToFiring) {
  const auto packets = recorded_packets();
  if (packets.empty()) GTEST_SKIP() << "no recording (SPARSIGHT_DATA)";
  Vlp16Decoder decoder;
  DecodedPacket out;
  TimedReturn before;
  bool any = false;
  for (const LidarPacket& packet : packets) {
    ASSERT_TRUE(decoder.decode(packet, out));
    for (const TimedReturn& point : out.returns) {
      if (any) {
        ASSERT_GT(point.fired, before.fired);
        ASSERT_GT(degrees_on(before.azimuth_deg, point.azimuth_deg), 0.0);
      }
      before = point;
      any = true;
    }
  }
}

TEST(Vlp16Recording, MakesThirteenRevolutionsWithoutAGap) {
  const auto packets = recorded_packets();
  if (packets.empty()) GTEST_SKIP() << "no recording (SPARSIGHT_DATA)";
  Vlp16Decoder decoder;
  SweepAssembler assembler;
  DecodedPacket out;
  for (const LidarPacket& packet : packets) {
    ASSERT_TRUE(decoder.decode(packet, out));
    assembler.add(out);
  }
  assembler.flush();
  std::uint64_t received = 0;
  int whole = 0;
  while (const auto revolution = assembler.take()) {
    received += revolution->received_firings;
    if (!revolution->whole) continue;
    ++whole;
    EXPECT_NEAR(static_cast<double>(revolution->received_firings),
                static_cast<double>(revolution->expected_firings), 17.0);
    EXPECT_NEAR(to_seconds(revolution->end - revolution->begin), 0.1, 0.002);
  }
  EXPECT_EQ(whole, 13) << "and a part at each end";
  EXPECT_EQ(received, 1000U * 384U);
}

TEST(Vlp16Recording, NextPacketBeginsWhereTheOneBeforeWasSaidToEnd) {
  const auto packets = recorded_packets();
  if (packets.empty()) GTEST_SKIP() << "no recording (SPARSIGHT_DATA)";
  Vlp16Decoder decoder;
  DecodedPacket out;
  double expected = -1.0;
  for (const LidarPacket& packet : packets) {
    ASSERT_TRUE(decoder.decode(packet, out));
    if (expected >= 0.0) {
      // Azimuths are rounded to 0.01 degrees, and the motor's speed is controlled.
      ASSERT_LT(std::abs(degrees_on(expected, out.first_azimuth_deg)), 0.05);
    }
    expected = out.first_azimuth_deg + out.turned_deg;
  }
}

}  // namespace
}  // namespace sparsight
