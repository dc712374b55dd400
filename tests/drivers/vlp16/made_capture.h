#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sparsight::testing {

using Bytes = std::vector<std::uint8_t>;

inline void append(Bytes& bytes, std::span<const std::uint8_t> more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
}
inline void append_big_16(Bytes& bytes, std::size_t number) {
  bytes.push_back(static_cast<std::uint8_t>(number >> 8));
  bytes.push_back(static_cast<std::uint8_t>(number));
}
inline void append_little_32(Bytes& bytes, std::uint32_t number) {
  for (int shift = 0; shift < 32; shift += 8) {
    bytes.push_back(static_cast<std::uint8_t>(number >> shift));
  }
}

struct MadeFrame {
  std::uint8_t last_octet = 201;  // of the sender, 192.168.1.x
  std::uint16_t port = 2368;
  int vlan_tags = 0;
  std::uint16_t fragment = 0x4000;  // flags and offset; don't fragment
  std::uint8_t protocol = 17;
  Bytes payload;
};

// An Ethernet frame with an IPv4 header of 20 bytes.
inline Bytes frame_of(const MadeFrame& made) {
  Bytes frame(12, 0x11);
  for (int tag = 0; tag < made.vlan_tags; ++tag) {
    append_big_16(frame, tag == 0 ? 0x88A8 : 0x8100);
    append_big_16(frame, 5);
  }
  append_big_16(frame, 0x0800);
  append_big_16(frame, 0x4500);
  append_big_16(frame, 28 + made.payload.size());
  append_big_16(frame, 7);
  append_big_16(frame, made.fragment);
  frame.push_back(255);
  frame.push_back(made.protocol);
  append_big_16(frame, 0);
  append(frame, Bytes{192, 168, 1, made.last_octet, 255, 255, 255, 255});
  append_big_16(frame, 2368);
  append_big_16(frame, made.port);
  append_big_16(frame, 8 + made.payload.size());
  append_big_16(frame, 0);
  append(frame, made.payload);
  return frame;
}

// A capture file, in the byte order of x86.
class MadeCapture {
 public:
  explicit MadeCapture(bool nanoseconds = false, std::uint32_t link_type = 1) {
    append_little_32(bytes_, nanoseconds ? 0xA1B23C4D : 0xA1B2C3D4);
    append(bytes_, Bytes{2, 0, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    append_little_32(bytes_, 65535);
    append_little_32(bytes_, link_type);
  }
  void add(std::uint32_t seconds, std::uint32_t fraction, const Bytes& frame,
           std::size_t captured = 1 << 20) {
    const std::size_t kept = captured < frame.size() ? captured : frame.size();
    append_little_32(bytes_, seconds);
    append_little_32(bytes_, fraction);
    append_little_32(bytes_, static_cast<std::uint32_t>(kept));
    append_little_32(bytes_, static_cast<std::uint32_t>(frame.size()));
    append(bytes_, std::span(frame).first(kept));
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

}  // namespace sparsight::testing
