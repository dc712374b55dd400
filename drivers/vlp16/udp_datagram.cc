#include "drivers/vlp16/udp_datagram.h"

namespace sparsight {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kAddresses = 12;  // two of six bytes, before the type
constexpr std::size_t kTag = 4;
constexpr int kMaxTags = 2;
constexpr std::size_t kMinIpHeader = 20;
constexpr std::size_t kUdpHeader = 8;
constexpr std::uint8_t kUdp = 17;
constexpr unsigned kMoreFragmentsOrOffset = 0x3FFF;

// Big-endian, as networks are.
std::uint16_t number16(Bytes bytes, std::size_t at) {
  return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}
std::uint32_t number32(Bytes bytes, std::size_t at) {
  return static_cast<std::uint32_t>(number16(bytes, at)) << 16 | number16(bytes, at + 2);
}

tl::unexpected<FrameFault> refuse(FrameFault fault) { return tl::make_unexpected(fault); }

tl::expected<UdpDatagram, FrameFault> udp_of_ip(Bytes packet) {
  if (packet.size() < kMinIpHeader) return refuse(FrameFault::kTruncated);
  const std::size_t header = 4U * (packet[0] & 0x0FU);
  const std::size_t length = number16(packet, 2);
  if (packet[0] >> 4 != 4 || packet[9] != kUdp) return refuse(FrameFault::kOther);
  if ((number16(packet, 6) & kMoreFragmentsOrOffset) != 0) return refuse(FrameFault::kFragment);
  // Short frames are padded: what counts is the packet's own length.
  if (header < kMinIpHeader || length < header + kUdpHeader || length > packet.size()) {
    return refuse(FrameFault::kTruncated);
  }
  const Bytes udp = packet.subspan(header, length - header);
  const std::size_t udp_length = number16(udp, 4);
  if (udp_length < kUdpHeader || udp_length > udp.size()) return refuse(FrameFault::kTruncated);
  return UdpDatagram{number32(packet, 12), number16(udp, 2),
                     udp.subspan(kUdpHeader, udp_length - kUdpHeader)};
}

}  // namespace

tl::expected<UdpDatagram, FrameFault> udp_of_ethernet(Bytes frame) {
  std::size_t type_at = kAddresses;
  for (int tags = 0; tags <= kMaxTags; ++tags) {
    if (frame.size() < type_at + 2) return refuse(FrameFault::kTruncated);
    const std::uint16_t type = number16(frame, type_at);
    if (type == 0x0800) return udp_of_ip(frame.subspan(type_at + 2));
    if (type != 0x8100 && type != 0x88A8) break;
    type_at += kTag;
  }
  return refuse(FrameFault::kOther);
}

}  // namespace sparsight
