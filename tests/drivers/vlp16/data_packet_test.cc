#include "drivers/vlp16/data_packet.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/drivers/vlp16/made_packets.h"

namespace sparsight {
namespace {

using testing::MadePacket;
using testing::payload_of;

DataPacket reading_of(const MadePacket& made) {
  DataPacket packet;
  EXPECT_TRUE(read_data_packet(payload_of(made), packet));
  return packet;
}

PacketFault fault_of_bytes(const DataPayload& bytes) {
  DataPacket packet;
  const auto read = read_data_packet(bytes, packet);
  EXPECT_FALSE(read);
  return read ? PacketFault{255} : read.error();
}

double azimuth_of_firing(const SequenceReading& sequence, int laser) {
  return sequence.azimuth_deg + laser * sequence.turn_per_firing_deg;
}

// By hand: 0.4 degrees in 110.592 us; channel 17 fires 57.6 us after the block's first.
TEST(DataPacket, TurnsOnBetweenTheAzimuthsOfBlocks) {
  const DataPacket packet = reading_of({.first_azimuth_centideg = 10000});
  ASSERT_EQ(packet.sequence_count, 24U);
  EXPECT_DOUBLE_EQ(packet.sequences[0].azimuth_deg, 100.0);
  EXPECT_NEAR(azimuth_of_firing(packet.sequences[1], 1), 100.0 + 0.4 * 57.6 / 110.592, 1e-9);
  EXPECT_NEAR(packet.turned_deg, 4.8, 1e-9);
}

TEST(DataPacket, TurnsOnAfterTheLastBlockAsBefore) {
  const DataPacket packet = reading_of({.first_azimuth_centideg = 10000});
  // Channel 31 of block 11: 89.856 us after the block's first firing.
  EXPECT_NEAR(azimuth_of_firing(packet.sequences[23], 15), 104.4 + 0.4 * 89.856 / 110.592, 1e-9);
}

TEST(DataPacket, InterpolatesEvenBlocksOfDualPairsToTheNextPair) {
  const DataPacket packet =
      reading_of({.first_azimuth_centideg = 10000, .mode = ReturnMode::kDual});
  ASSERT_EQ(packet.sequence_count, 12U);
  EXPECT_NEAR(packet.sequences[1].azimuth_deg, 100.2, 1e-9);
  EXPECT_NEAR(packet.sequences[2].azimuth_deg, 100.4, 1e-9);
  EXPECT_NEAR(azimuth_of_firing(packet.sequences[11], 15), 102.0 + 0.4 * 89.856 / 110.592, 1e-9);
  EXPECT_NEAR(packet.turned_deg, 2.4, 1e-9);
}

TEST(DataPacket, WrapsInsideAPacketWithoutLosingABlock) {
  for (const ReturnMode mode : {ReturnMode::kStrongest, ReturnMode::kDual}) {
    // The wrap lies between the first two blocks.
    const DataPacket packet = reading_of({.first_azimuth_centideg = 35970, .mode = mode});
    EXPECT_NEAR(packet.sequences[0].azimuth_deg, 359.7, 1e-9);
    EXPECT_NEAR(packet.sequences[1].azimuth_deg, 359.9, 1e-9);
    EXPECT_NEAR(azimuth_of_firing(packet.sequences[1], 15), 359.9 + 0.4 * 34.56 / 110.592, 1e-9);
    EXPECT_NEAR(packet.sequences[2].azimuth_deg, 0.1, 1e-9);
    EXPECT_NEAR(packet.turned_deg, mode == ReturnMode::kDual ? 2.4 : 4.8, 1e-9);
  }
}

TEST(DataPacket, WrapsBetweenTheSequencesOfABlock) {
  const DataPacket packet = reading_of({.first_azimuth_centideg = 35990});
  EXPECT_NEAR(packet.sequences[1].azimuth_deg, 0.1, 1e-9);
}

TEST(DataPacket, TellsTheSameReturnOnce) {
  const DataPacket same = reading_of({.mode = ReturnMode::kDual});
  EXPECT_EQ(same.sequences[3].echoes[5].distance_2mm, 5000);
  EXPECT_EQ(same.sequences[3].second_echoes[5].distance_2mm, 0);
  const DataPacket two = reading_of({.mode = ReturnMode::kDual, .second_distance_2mm = 3000});
  EXPECT_EQ(two.sequences[3].echoes[5].distance_2mm, 5000);
  EXPECT_EQ(two.sequences[3].echoes[5].reflectivity, 10);
  EXPECT_EQ(two.sequences[3].second_echoes[5].distance_2mm, 3000);
  EXPECT_EQ(two.sequences[3].second_echoes[5].reflectivity, 11);
}

TEST(DataPacket, KeepsASecondReturnWithoutAFirst) {
  const DataPacket packet =
      reading_of({.mode = ReturnMode::kDual, .distance_2mm = 0, .second_distance_2mm = 3000});
  EXPECT_EQ(packet.sequences[0].echoes[0].distance_2mm, 0);
  EXPECT_EQ(packet.sequences[0].second_echoes[0].distance_2mm, 3000);
}

TEST(DataPacket, DoesNotInferDualFromEqualBlocks) {
  const DataPacket packet = reading_of({.block_gap_centideg = 0});
  EXPECT_EQ(packet.mode, ReturnMode::kStrongest);
  EXPECT_EQ(packet.sequence_count, 24U);
  EXPECT_EQ(packet.sequences[0].turn_per_firing_deg, 0.0) << "the head stands still";
}

TEST(DataPacket, TakesNoRateFromTheDeadArcOfANarrowedView) {
  DataPayload bytes = payload_of({.first_azimuth_centideg = 8000});
  // From block 6 on the other side of 200 dead degrees.
  for (std::size_t b = 6; b < 12; ++b) {
    const std::size_t azimuth = 28240 + 40 * (b - 6);
    bytes[100 * b + 2] = static_cast<std::uint8_t>(azimuth % 256);
    bytes[100 * b + 3] = static_cast<std::uint8_t>(azimuth / 256);
  }
  DataPacket packet;
  ASSERT_TRUE(read_data_packet(bytes, packet));
  EXPECT_NEAR(packet.sequences[11].azimuth_deg, 82.2, 1e-9) << "the block before the dead arc";
  EXPECT_NEAR(packet.sequences[12].azimuth_deg, 282.4, 1e-9);
  EXPECT_NEAR(packet.turned_deg, 202.4 + 2.4, 1e-9);
}

TEST(DataPacket, TellsTheHiResFromTheVlp16) {
  DataPayload bytes = payload_of({});
  DataPacket packet;
  ASSERT_TRUE(read_data_packet(bytes, packet));
  EXPECT_EQ(packet.model, LidarModel::kVlp16);
  bytes[1205] = 0x24;
  ASSERT_TRUE(read_data_packet(bytes, packet));
  EXPECT_EQ(packet.model, LidarModel::kVlp16HiRes);
}

TEST(DataPacket, RefusesOtherVelodynes) {
  DataPayload bytes = payload_of({});
  for (const int product : {0x00, 0x21, 0x23, 0x28, 0xFF}) {
    bytes[1205] = static_cast<std::uint8_t>(product);
    EXPECT_EQ(fault_of_bytes(bytes), PacketFault::kProduct) << product;
  }
}

TEST(DataPacket, RefusesUnknownReturnModes) {
  DataPayload bytes = payload_of({});
  for (const int mode : {0x00, 0x36, 0x3A}) {
    bytes[1204] = static_cast<std::uint8_t>(mode);
    EXPECT_EQ(fault_of_bytes(bytes), PacketFault::kReturnMode) << mode;
  }
}

TEST(DataPacket, RefusesABrokenFlagInAnyBlock) {
  for (std::size_t block = 0; block < kVlp16BlocksPerPacket; ++block) {
    DataPayload bytes = payload_of({});
    bytes[100 * block + 1] = 0xDD;  // the lower lasers of an HDL-64E
    EXPECT_EQ(fault_of_bytes(bytes), PacketFault::kBlockFlag) << block;
  }
}

TEST(DataPacket, RefusesAnAzimuthBeyondAFullTurnInAnyBlock) {
  for (std::size_t block = 0; block < kVlp16BlocksPerPacket; ++block) {
    DataPayload bytes = payload_of({});
    bytes[100 * block + 2] = 0xA0;  // 36000
    bytes[100 * block + 3] = 0x8C;
    EXPECT_EQ(fault_of_bytes(bytes), PacketFault::kAzimuth) << block;
    bytes[100 * block + 2] = 0x9F;
    DataPacket packet;
    EXPECT_TRUE(read_data_packet(bytes, packet)) << "359.99 is one";
  }
}

TEST(DataPacket, RefusesDualPairsThatLookedApart) {
  DataPayload bytes = payload_of({.mode = ReturnMode::kDual});
  bytes[302] = static_cast<std::uint8_t>(bytes[302] + 1);
  EXPECT_EQ(fault_of_bytes(bytes), PacketFault::kPair);
}

RC_GTEST_PROP(DataPacket, GivesTheFiringsOfAnEvenTurnTheirExactAzimuth, ()) {
  const int first = *rc::gen::inRange(0, 36000);
  const int gap = *rc::gen::inRange(15, 81);
  const auto mode = *rc::gen::element(ReturnMode::kStrongest, ReturnMode::kLast, ReturnMode::kDual);
  const DataPacket packet =
      reading_of({.first_azimuth_centideg = first, .block_gap_centideg = gap, .mode = mode});
  const double per_sequence = 0.01 * gap / 2;
  for (std::size_t s = 0; s < packet.sequence_count; ++s) {
    const double azimuth = packet.sequences[s].azimuth_deg;
    RC_ASSERT(azimuth >= 0.0 && azimuth < 360.0);
    const double expected = 0.01 * first + static_cast<double>(s) * per_sequence;
    RC_ASSERT(std::abs(std::remainder(azimuth - expected, 360.0)) < 1e-9);
    RC_ASSERT(std::abs(packet.sequences[s].turn_per_firing_deg - per_sequence / 24) < 1e-12);
  }
}

}  // namespace
}  // namespace sparsight
