#include "drivers/vlp16/packet_writer.h"

#include <gtest/gtest.h>

#include "tests/drivers/vlp16/made_packets.h"

namespace sparsight {
namespace {

using testing::payload_of;

TEST(PacketWriter, PutsEveryFieldWhereTheManualHasIt) {
  std::array<FiringSequence, kVlp16SequencesPerPacket> sequences;
  sequences[0].azimuth_centideg = 0x1234;
  sequences[0].distance_2mm[1] = 0x0302;
  sequences[0].reflectivity[1] = 0x4B;
  sequences[23].distance_2mm[15] = 0xFFFE;
  sequences[23].reflectivity[15] = 0x64;
  const DataPayload bytes = write_data_packet(sequences, 0xD693A400, ReturnMode::kStrongest);
  EXPECT_EQ(bytes[0], 0xFF);
  EXPECT_EQ(bytes[1], 0xEE);
  EXPECT_EQ(bytes[2], 0x34);
  EXPECT_EQ(bytes[3], 0x12);
  EXPECT_EQ(bytes[7], 0x02) << "the second laser, three bytes after the first";
  EXPECT_EQ(bytes[8], 0x03);
  EXPECT_EQ(bytes[9], 0x4B);
  EXPECT_EQ(bytes[1100], 0xFF) << "the last block";
  EXPECT_EQ(bytes[1197], 0xFE) << "its last channel";
  EXPECT_EQ(bytes[1198], 0xFF);
  EXPECT_EQ(bytes[1199], 0x64);
  EXPECT_EQ(bytes[1200], 0x00);
  EXPECT_EQ(bytes[1201], 0xA4);
  EXPECT_EQ(bytes[1202], 0x93);
  EXPECT_EQ(bytes[1203], 0xD6);
  EXPECT_EQ(bytes[1204], 0x37);
  EXPECT_EQ(bytes[1205], 0x22);
}

TEST(PacketWriter, NamesTheReturnMode) {
  EXPECT_EQ(payload_of({.mode = ReturnMode::kLast})[1204], 0x38);
  EXPECT_EQ(payload_of({.mode = ReturnMode::kDual})[1204], 0x39);
}

TEST(PacketWriter, PutsPositionFieldsWhereTheManualHasThem) {
  const PositionPayload bytes = write_position_packet(0x01020304, PpsState::kLocked, "$GPRMC,x");
  EXPECT_EQ(bytes[198], 0x04);
  EXPECT_EQ(bytes[201], 0x01);
  EXPECT_EQ(bytes[202], 2);
  EXPECT_EQ(bytes[206], '$');
  EXPECT_EQ(bytes[213], 'x');
  EXPECT_EQ(bytes[214], 0);
}

TEST(PacketWriter, CutsASentenceThatDoesNotFit) {
  const PositionPayload bytes = write_position_packet(0, PpsState::kAbsent, std::string(1000, 'N'));
  EXPECT_EQ(bytes[510], 'N');
  EXPECT_EQ(bytes[511], 0);
}

}  // namespace
}  // namespace sparsight
