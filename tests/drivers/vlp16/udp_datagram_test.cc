#include "drivers/vlp16/udp_datagram.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/drivers/vlp16/made_capture.h"

namespace sparsight {
namespace {

using testing::Bytes;
using testing::frame_of;

TEST(UdpDatagram, FindsSenderPortAndPayload) {
  const Bytes frame = frame_of({.payload = {1, 2, 3}});
  const auto datagram = udp_of_ethernet(frame);
  ASSERT_TRUE(datagram);
  EXPECT_EQ(datagram->source, 0xC0A801C9U);
  EXPECT_EQ(datagram->destination_port, 2368);
  EXPECT_EQ(Bytes(datagram->payload.begin(), datagram->payload.end()), Bytes({1, 2, 3}));
}

TEST(UdpDatagram, LooksThroughVlanTags) {
  for (int tags = 1; tags <= 2; ++tags) {
    const Bytes frame = frame_of({.vlan_tags = tags, .payload = {1, 2, 3}});
    const auto datagram = udp_of_ethernet(frame);
    ASSERT_TRUE(datagram) << tags;
    EXPECT_EQ(datagram->payload.size(), 3U);
  }
}

TEST(UdpDatagram, LeavesOutThePaddingOfShortFrames) {
  Bytes frame = frame_of({.payload = {1, 2, 3}});
  frame.resize(60, 0xAA);
  const auto datagram = udp_of_ethernet(frame);
  ASSERT_TRUE(datagram);
  EXPECT_EQ(datagram->payload.size(), 3U);
}

TEST(UdpDatagram, RefusesFragments) {
  for (const int flags : {0x2000, 0x0001, 0x20B9}) {
    const Bytes frame =
        frame_of({.fragment = static_cast<std::uint16_t>(flags), .payload = {1, 2, 3}});
    EXPECT_EQ(udp_of_ethernet(frame).error(), FrameFault::kFragment) << flags;
  }
}

TEST(UdpDatagram, PassesOverOtherProtocols) {
  EXPECT_EQ(udp_of_ethernet(frame_of({.protocol = 6})).error(), FrameFault::kOther);
  Bytes arp(60, 0);
  arp[12] = 8;
  arp[13] = 6;
  EXPECT_EQ(udp_of_ethernet(arp).error(), FrameFault::kOther);
  Bytes ipv6 = frame_of({.payload = {1}});
  ipv6[14] = 0x65;
  EXPECT_EQ(udp_of_ethernet(ipv6).error(), FrameFault::kOther);
}

TEST(UdpDatagram, RefusesLengthsThatDoNotFit) {
  const Bytes good = frame_of({.payload = {1, 2, 3}});
  Bytes frame = good;
  frame[14] = 0x44;  // a header of 16 bytes
  EXPECT_EQ(udp_of_ethernet(frame).error(), FrameFault::kTruncated);
  frame = good;
  frame[17] = 27;  // no room for the UDP header
  EXPECT_EQ(udp_of_ethernet(frame).error(), FrameFault::kTruncated);
  frame = good;
  frame[17] = 200;  // beyond the frame
  EXPECT_EQ(udp_of_ethernet(frame).error(), FrameFault::kTruncated);
  frame = good;
  frame[39] = 7;  // UDP shorter than its header
  EXPECT_EQ(udp_of_ethernet(frame).error(), FrameFault::kTruncated);
  frame[39] = 12;  // UDP longer than its packet
  EXPECT_EQ(udp_of_ethernet(frame).error(), FrameFault::kTruncated);
}

RC_GTEST_PROP(UdpDatagram, EveryCutFrameIsRefused, (std::uint8_t tags)) {
  const Bytes frame = frame_of({.vlan_tags = tags % 3, .payload = Bytes(100, 7)});
  const auto length = *rc::gen::inRange<std::size_t>(0, frame.size());
  const auto datagram = udp_of_ethernet(std::span(frame).first(length));
  RC_ASSERT(!datagram && datagram.error() == FrameFault::kTruncated);
}

}  // namespace
}  // namespace sparsight
