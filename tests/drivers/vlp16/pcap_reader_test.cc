#include "drivers/vlp16/pcap_reader.h"

#include <gtest/gtest.h>

#include "tests/drivers/vlp16/made_capture.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using testing::Bytes;
using testing::frame_of;
using testing::MadeCapture;

PcapReader reader_of(const Bytes& bytes) {
  auto reader = PcapReader::read(bytes, "made.pcap");
  EXPECT_TRUE(reader) << reader.error().message;
  return std::move(*reader);
}

TEST(PcapReader, ReadsStampsInMicroseconds) {
  MadeCapture capture;
  capture.add(1'700'000'000, 123'456, frame_of({.payload = {1, 2}}));
  PcapReader reader = reader_of(capture.bytes());
  const auto datagram = reader.next();
  ASSERT_TRUE(datagram);
  EXPECT_EQ(datagram->captured, 1'700'000'000s + 123'456us);
  EXPECT_EQ(datagram->datagram.payload.size(), 2U);
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.damage(), "");
}

TEST(PcapReader, ReadsStampsInNanoseconds) {
  MadeCapture capture(true);
  capture.add(1'700'000'000, 123'456'789, frame_of({.payload = {1, 2}}));
  PcapReader reader = reader_of(capture.bytes());
  const auto datagram = reader.next();
  ASSERT_TRUE(datagram);
  EXPECT_EQ(datagram->captured, 1'700'000'000s + 123'456'789ns);
}

TEST(PcapReader, CountsTruncatedRecordsAndFragmentsButNotOtherTraffic) {
  MadeCapture capture;
  capture.add(1, 0, frame_of({.payload = Bytes(500, 1)}), 96);  // as tcpdump -s 96 does
  capture.add(2, 0, frame_of({.fragment = 0x2000, .payload = {1}}));
  capture.add(3, 0, frame_of({.protocol = 6, .payload = {1}}));
  capture.add(4, 0, frame_of({.payload = {9}}));
  PcapReader reader = reader_of(capture.bytes());
  const auto datagram = reader.next();
  ASSERT_TRUE(datagram);
  EXPECT_EQ(datagram->captured, 4s);
  EXPECT_EQ(reader.refused(), 2U);
}

TEST(PcapReader, KeepsWhatComesBeforeACut) {
  MadeCapture capture;
  capture.add(1, 0, frame_of({.payload = {1}}));
  capture.add(2, 0, frame_of({.payload = {2}}));
  Bytes bytes = capture.bytes();
  bytes.resize(bytes.size() - 5);
  PcapReader reader = reader_of(bytes);
  EXPECT_TRUE(reader.next());
  EXPECT_FALSE(reader.next());
  EXPECT_FALSE(reader.next()) << "and stays so";
  EXPECT_NE(reader.damage(), "");
  EXPECT_EQ(reader.refused(), 1U);
}

TEST(PcapReader, RefusesStampsThatAreNone) {
  MadeCapture capture(true);
  capture.add(1, 4'000'000'000U, frame_of({.payload = {1}}));
  PcapReader reader = reader_of(capture.bytes());
  EXPECT_FALSE(reader.next());
  EXPECT_EQ(reader.refused(), 1U);
}

TEST(PcapReader, SaysWhatIsWrongWithAFile) {
  const auto missing = PcapReader::open("/nowhere/a.pcap");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
  EXPECT_NE(missing.error().message.find("/nowhere/a.pcap"), std::string::npos);
  const Bytes junk(100, 'x');
  const auto no_capture = PcapReader::read(junk, "junk.pcap");
  ASSERT_FALSE(no_capture);
  EXPECT_NE(no_capture.error().message.find("junk.pcap"), std::string::npos);
  EXPECT_FALSE(PcapReader::read({}, "empty.pcap"));
  const MadeCapture of_any(false, 113);
  const auto cooked = PcapReader::read(of_any.bytes(), "any.pcap");
  ASSERT_FALSE(cooked);
  EXPECT_NE(cooked.error().message.find("not Ethernet"), std::string::npos);
}

}  // namespace
}  // namespace sparsight
