#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "hal/result.h"

namespace sparsight {

// Sends as the LiDAR does: UDP, one datagram a packet. Thread-bound.
class PacketSender {
 public:
  // Towards this IPv4 address, from whichever of ours leads there.
  static Result<PacketSender> open(const std::string& to);
  ~PacketSender();
  PacketSender(PacketSender&& other) noexcept;
  PacketSender(const PacketSender&) = delete;
  PacketSender& operator=(const PacketSender&) = delete;
  PacketSender& operator=(PacketSender&&) = delete;

  // 0, or a negative errno.
  int send(std::span<const std::uint8_t> payload, std::uint16_t port);

 private:
  PacketSender(int socket, std::uint32_t address) : socket_(socket), address_(address) {}

  int socket_;
  std::uint32_t address_;  // the first octet in the highest byte
};

}  // namespace sparsight
