#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "hal/result.h"

namespace sparsight {

struct ReceivedDatagram {
  std::chrono::nanoseconds stamp{0};  // the kernel's, by CLOCK_REALTIME
  std::uint32_t source = 0;           // IPv4 address, the first octet in the highest byte
  std::size_t size = 0;               // as sent, which may be more than `payload` holds
  std::span<const std::uint8_t> payload;
};

// A UDP port, read in batches without waiting and without allocating. Thread-bound.
class UdpReceiver {
 public:
  static constexpr std::size_t kBatch = 32;
  // No datagram larger than this is wanted; of such a one the size is told.
  static constexpr std::size_t kMaxPayload = 1206;

  // Port 0 takes any free one.
  static Result<UdpReceiver> open(const std::string& address, std::uint16_t port, int buffer_bytes);
  UdpReceiver(UdpReceiver&& other) noexcept;
  UdpReceiver& operator=(UdpReceiver&& other) noexcept;
  UdpReceiver(const UdpReceiver&) = delete;
  UdpReceiver& operator=(const UdpReceiver&) = delete;
  ~UdpReceiver();

  // What waits, up to a batch; valid until the next call.
  std::span<const ReceivedDatagram> receive();

  int descriptor() const { return descriptor_; }
  std::uint16_t port() const;
  // What the kernel grants: without privilege no more than net.core.rmem_max.
  int buffer_bytes() const;
  std::uint64_t dropped() const { return dropped_; }  // by the kernel, as of the last datagram

 private:
  struct Batch;
  explicit UdpReceiver(int descriptor);
  void read_ancillary(msghdr& header, ReceivedDatagram& datagram);

  int descriptor_ = -1;
  std::unique_ptr<Batch> batch_;
  std::uint32_t overflow_count_ = 0;
  std::uint64_t dropped_ = 0;
};

// "192.168.1.201" as a number with the first octet in the highest byte.
Result<std::uint32_t> ipv4_address(const std::string& text);

}  // namespace sparsight
