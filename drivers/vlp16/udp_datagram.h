#pragma once

#include <cstdint>
#include <span>
#include <tl/expected.hpp>

namespace sparsight {

struct UdpDatagram {
  std::uint32_t source = 0;  // IPv4 address, the first octet in the highest byte
  std::uint16_t destination_port = 0;
  std::span<const std::uint8_t> payload;  // within the frame
};

enum class FrameFault : std::uint8_t {
  kOther,      // a frame, but of another protocol
  kTruncated,  // ends before its own lengths say
  kFragment,   // a part of a datagram; the LiDAR's fit into one frame
};

// What an Ethernet frame carries (IEEE 802.3, VLAN tags of 802.1Q and 802.1ad skipped; RFC 791,
// RFC 768). Checksums are not looked at: the network card has.
tl::expected<UdpDatagram, FrameFault> udp_of_ethernet(std::span<const std::uint8_t> frame);

}  // namespace sparsight
