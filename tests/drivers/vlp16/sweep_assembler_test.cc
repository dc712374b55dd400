#include "drivers/vlp16/sweep_assembler.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "drivers/vlp16/vlp16_decoder.h"
#include "tests/drivers/vlp16/made_packets.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using testing::MadePacket;
using testing::packet_of;

// A sensor that turns evenly, its packets decoded.
class TurningSensor {
 public:
  explicit TurningSensor(int block_gap_centideg = 40, int first_azimuth_centideg = 0) {
    made_.block_gap_centideg = block_gap_centideg;
    made_.first_azimuth_centideg = first_azimuth_centideg;
  }
  void set_distance(std::uint16_t distance_2mm) { made_.distance_2mm = distance_2mm; }
  void set_clock(std::uint32_t microseconds) { time_ = std::chrono::microseconds(microseconds); }
  void stop_turning() { made_.block_gap_centideg = 0; }
  void skip(int packets) {
    for (int i = 0; i < packets; ++i) move_on();
  }
  DecodedPacket next() {
    made_.microseconds_past_hour = static_cast<std::uint32_t>(time_ / 1us);
    DecodedPacket out;
    EXPECT_TRUE(decoder_.decode(packet_of(made_, arrival_), out));
    move_on();
    return out;
  }

 private:
  void move_on() {
    time_ += kVlp16PacketInterval;
    arrival_ += kVlp16PacketInterval;
    made_.first_azimuth_centideg =
        (made_.first_azimuth_centideg + 12 * made_.block_gap_centideg) % 36000;
  }
  Vlp16Decoder decoder_;
  MadePacket made_;
  std::chrono::nanoseconds time_{0};
  HostTime arrival_{100s};
};

std::vector<Revolution> all_of(SweepAssembler& assembler) {
  std::vector<Revolution> revolutions;
  while (auto revolution = assembler.take()) revolutions.push_back(std::move(*revolution));
  return revolutions;
}

double past_seam(const TimedReturn& point, double seam_deg) {
  return std::fmod(point.azimuth_deg - seam_deg + 720.0, 360.0);
}

TEST(SweepAssembler, CutsAtTheSeamInTheMiddleOfAPacket) {
  // Packets begin at multiples of 4.8 degrees: 91.3 lies within one, and within a sequence.
  constexpr double kSeam = 91.3;
  SweepAssembler assembler({.seam_azimuth_deg = kSeam});
  TurningSensor sensor;
  std::size_t fed = 0;
  for (int i = 0; i < 320; ++i) {
    const DecodedPacket packet = sensor.next();
    fed += packet.returns.size();
    assembler.add(packet);
  }
  assembler.flush();
  const auto revolutions = all_of(assembler);
  ASSERT_EQ(revolutions.size(), 6U);
  std::size_t gathered = 0;
  for (const Revolution& revolution : revolutions) gathered += revolution.returns.size();
  EXPECT_EQ(gathered, fed) << "none lost, none told twice";
  for (std::size_t i = 1; i + 1 < revolutions.size(); ++i) {
    const Revolution& revolution = revolutions[i];
    EXPECT_TRUE(revolution.whole);
    EXPECT_LT(past_seam(revolution.returns.front(), kSeam), 0.01);
    EXPECT_GT(past_seam(revolution.returns.back(), kSeam), 359.92);
    EXPECT_EQ(revolution.begin, revolutions[i - 1].end);
    EXPECT_NEAR(to_seconds(revolution.end - revolution.begin), 0.0995328, 2e-6);
    EXPECT_NEAR(static_cast<double>(revolution.expected_firings), 28800.0, 1.0);
    EXPECT_NEAR(static_cast<double>(revolution.received_firings), 28800.0, 16.0);
  }
  EXPECT_FALSE(revolutions.front().whole);
  EXPECT_FALSE(revolutions.back().whole);
  EXPECT_EQ(revolutions.back().ended_by, Revolution::End::kFlush);
}

TEST(SweepAssembler, BeginsWholeWhenTheFirstPacketBeginsAtTheSeam) {
  SweepAssembler assembler({.seam_azimuth_deg = 180.0});
  TurningSensor sensor(40, 18000);
  for (int i = 0; i < 80; ++i) assembler.add(sensor.next());
  const auto revolutions = all_of(assembler);
  ASSERT_EQ(revolutions.size(), 1U);
  EXPECT_TRUE(revolutions[0].whole);
  EXPECT_EQ(revolutions[0].returns.size(), 75U * 384U);
}

TEST(SweepAssembler, KeepsAFiringThatAFloatPutsBeforeItsPacket) {
  // 0.01 is a little less as a float.
  SweepAssembler assembler({.seam_azimuth_deg = 0.01});
  TurningSensor sensor(40, 1);
  for (int i = 0; i < 80; ++i) assembler.add(sensor.next());
  const auto revolutions = all_of(assembler);
  ASSERT_EQ(revolutions.size(), 1U);
  EXPECT_EQ(revolutions[0].returns.size(), 75U * 384U);
  EXPECT_EQ(revolutions[0].received_firings, 75U * 384U);
}

TEST(SweepAssembler, CutsDualPacketsAsWell) {
  SweepAssembler assembler({.seam_azimuth_deg = 0.0});
  Vlp16Decoder decoder;
  for (int i = 0; i < 400; ++i) {
    DecodedPacket out;
    ASSERT_TRUE(
        decoder.decode(packet_of({.first_azimuth_centideg = (240 * i + 110) % 36000,
                                  .microseconds_past_hour = static_cast<std::uint32_t>(i * 663.552),
                                  .mode = ReturnMode::kDual,
                                  .second_distance_2mm = 2500}),
                       out));
    assembler.add(out);
  }
  const auto revolutions = all_of(assembler);
  ASSERT_EQ(revolutions.size(), 2U);
  EXPECT_TRUE(revolutions[1].whole);
  EXPECT_NEAR(static_cast<double>(revolutions[1].received_firings), 28800.0, 16.0);
  EXPECT_NEAR(static_cast<double>(revolutions[1].returns.size()), 57600.0, 64.0);
}

TEST(SweepAssembler, CountsFiringsWithoutReturn) {
  SweepAssembler assembler({.seam_azimuth_deg = 0.0});
  TurningSensor sensor;
  sensor.set_distance(0);
  for (int i = 0; i < 160; ++i) assembler.add(sensor.next());
  const auto revolutions = all_of(assembler);
  ASSERT_EQ(revolutions.size(), 2U) << "an empty sky has seams too";
  EXPECT_TRUE(revolutions[1].returns.empty());
  EXPECT_EQ(revolutions[1].received_firings, revolutions[1].expected_firings);
}

TEST(SweepAssembler, ExpectsTheFiringsOfLostPackets) {
  SweepAssembler assembler({.seam_azimuth_deg = 0.0});
  TurningSensor sensor(40, 120);
  for (int i = 0; i < 100; ++i) assembler.add(sensor.next());
  sensor.skip(5);
  for (int i = 0; i < 100; ++i) assembler.add(sensor.next());
  const auto revolutions = all_of(assembler);
  ASSERT_EQ(revolutions.size(), 2U);
  EXPECT_TRUE(revolutions[1].whole);
  EXPECT_NEAR(static_cast<double>(revolutions[1].expected_firings), 28800.0, 1.0);
  EXPECT_NEAR(static_cast<double>(revolutions[1].received_firings), 28800.0 - 5 * 384, 16.0);
}

TEST(SweepAssembler, FindsASeamThatLiesInALoss) {
  SweepAssembler assembler({.seam_azimuth_deg = 10.0});
  TurningSensor sensor;
  for (int i = 0; i < 75; ++i) assembler.add(sensor.next());
  sensor.skip(5);  // 0 to 24 degrees
  for (int i = 0; i < 80; ++i) assembler.add(sensor.next());
  const auto revolutions = all_of(assembler);
  ASSERT_EQ(revolutions.size(), 3U);
  EXPECT_NEAR(static_cast<double>(revolutions[1].expected_firings), 28800.0, 30.0);
  EXPECT_NEAR(static_cast<double>(revolutions[1].received_firings), 28800.0 - 800.0, 30.0);
  EXPECT_LT(revolutions[1].returns.back().azimuth_deg, 360.0);
  EXPECT_GT(revolutions[1].returns.back().azimuth_deg, 359.0);
  EXPECT_NEAR(revolutions[2].returns.front().azimuth_deg, 24.0, 0.01);
}

TEST(SweepAssembler, MakesNoEmptyRevolutionsOfALongLoss) {
  SweepAssembler assembler({.seam_azimuth_deg = 0.0});
  TurningSensor sensor(40, 120);
  for (int i = 0; i < 90; ++i) assembler.add(sensor.next());
  sensor.skip(3000);  // forty turns, four seconds
  for (int i = 0; i < 160; ++i) assembler.add(sensor.next());
  const auto revolutions = all_of(assembler);
  ASSERT_EQ(revolutions.size(), 4U);
  EXPECT_FALSE(revolutions[2].whole) << "the one that the sensor came back in";
  EXPECT_TRUE(revolutions[3].whole);
  for (const Revolution& revolution : revolutions) {
    EXPECT_LT(revolution.end - revolution.begin, 250ms);
    EXPECT_GT(revolution.received_firings, 0U);
  }
}

TEST(SweepAssembler, GivesWhatThereIsWhenTheHeadStandsStill) {
  SweepAssembler assembler({.seam_azimuth_deg = 180.0});
  TurningSensor sensor;
  sensor.stop_turning();
  for (int i = 0; i < 400; ++i) assembler.add(sensor.next());
  const auto revolutions = all_of(assembler);
  ASSERT_EQ(revolutions.size(), 2U);
  for (const Revolution& revolution : revolutions) {
    EXPECT_EQ(revolution.ended_by, Revolution::End::kTime);
    EXPECT_FALSE(revolution.whole);
    EXPECT_NEAR(to_seconds(revolution.end - revolution.begin), 0.25, 0.002);
  }
}

TEST(SweepAssembler, AClockJumpEndsTheRevolution) {
  SweepAssembler assembler({.seam_azimuth_deg = 0.0});
  TurningSensor sensor(40, 120);
  for (int i = 0; i < 100; ++i) assembler.add(sensor.next());
  sensor.set_clock(2'000'000'000);
  for (int i = 0; i < 100; ++i) assembler.add(sensor.next());
  const auto revolutions = all_of(assembler);
  ASSERT_EQ(revolutions.size(), 3U);
  EXPECT_EQ(revolutions[1].ended_by, Revolution::End::kClockJump);
  EXPECT_EQ(revolutions[1].epoch, 0U);
  EXPECT_EQ(revolutions[2].epoch, 1U);
  EXPECT_EQ(revolutions[2].begin, SensorTime(2000s));
  for (const Revolution& revolution : revolutions) {
    EXPECT_LE(revolution.returns.front().fired, revolution.returns.back().fired);
  }
}

RC_GTEST_PROP(SweepAssembler, PutsEveryReturnOnItsSideOfAnySeam, ()) {
  const int seam_centideg = *rc::gen::inRange(0, 36000);
  const double seam = seam_centideg * 0.01;
  const int gap = *rc::gen::inRange(19, 81);
  const int packet_turn = 12 * gap;
  // Past the seam twice, with a loss in between that may hold the seam as well.
  const int before_seam = *rc::gen::inRange(0, 4 * packet_turn);
  TurningSensor sensor(gap, (36000 + seam_centideg - before_seam) % 36000);
  SweepAssembler assembler({.seam_azimuth_deg = seam});
  std::size_t fed = 0;
  for (int i = 0; i < 12; ++i) {
    if (i == 6) sensor.skip(36000 / packet_turn - *rc::gen::inRange(2, 12));
    const DecodedPacket packet = sensor.next();
    fed += packet.returns.size();
    assembler.add(packet);
  }
  assembler.flush();
  std::size_t gathered = 0;
  for (const Revolution& revolution : all_of(assembler)) {
    gathered += revolution.returns.size();
    double before = 0.0;
    for (const TimedReturn& point : revolution.returns) {
      const double past = past_seam(point, seam);
      // A float's rounding may put what is fired at the seam on either side.
      if (past < 1e-3 || past > 360.0 - 1e-3) continue;
      RC_ASSERT(past > before);
      before = past;
    }
  }
  RC_ASSERT(gathered == fed);
}

}  // namespace
}  // namespace sparsight
