#include "tools/playback/packet_sender.h"

#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "drivers/vlp16/udp_receiver.h"

namespace sparsight {

Result<PacketSender> PacketSender::open(const std::string& to) {
  const auto address = ipv4_address(to);
  if (!address) return tl::unexpected(address.error());
  const int descriptor = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) {
    return fail(ErrorCode::kUnreadable, fmt::format("no UDP socket towards {}: {}", to,
                                                    std::generic_category().message(errno)));
  }
  return PacketSender(descriptor, *address);
}

PacketSender::~PacketSender() {
  if (socket_ >= 0) ::close(socket_);
}

PacketSender::PacketSender(PacketSender&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)), address_(other.address_) {}

int PacketSender::send(std::span<const std::uint8_t> payload, std::uint16_t port) {
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_port = htons(port);
  name.sin_addr.s_addr = htonl(address_);
  const ssize_t sent = ::sendto(socket_, payload.data(), payload.size(), 0,
                                reinterpret_cast<const sockaddr*>(&name), sizeof(name));
  return sent < 0 ? -errno : 0;
}

}  // namespace sparsight
