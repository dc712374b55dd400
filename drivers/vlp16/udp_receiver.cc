#include "drivers/vlp16/udp_receiver.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

namespace sparsight {

// The vectors that recvmmsg(2) fills, wired up once.
struct UdpReceiver::Batch {
  static constexpr std::size_t kAncillary =
      CMSG_SPACE(sizeof(std::timespec)) + CMSG_SPACE(sizeof(std::uint32_t));

  std::array<std::array<std::uint8_t, kMaxPayload>, kBatch> payloads;
  alignas(
      cmsghdr) std::array<std::array<std::uint8_t, (kAncillary + 15) / 16 * 16>, kBatch> ancillary;
  std::array<sockaddr_in, kBatch> sources;
  std::array<iovec, kBatch> vectors;
  std::array<mmsghdr, kBatch> messages{};
  std::array<ReceivedDatagram, kBatch> datagrams;

  void prepare() {
    for (std::size_t i = 0; i < kBatch; ++i) {
      vectors[i] = {payloads[i].data(), payloads[i].size()};
      msghdr& header = messages[i].msg_hdr;
      header = {};
      header.msg_name = &sources[i];
      header.msg_namelen = sizeof(sockaddr_in);
      header.msg_iov = &vectors[i];
      header.msg_iovlen = 1;
      header.msg_control = ancillary[i].data();
      header.msg_controllen = ancillary[i].size();
    }
  }
};

namespace {

Error socket_error(const std::string& address, std::uint16_t port, const std::string& what) {
  const int error = errno;
  const char* const fix =
      error == EADDRINUSE      ? "; another program is reading the LiDAR: stop it"
      : error == EADDRNOTAVAIL ? "; no interface of this machine has it: see lidar.bind_address"
      : error == EACCES        ? "; ports below 1024 need privileges: see lidar.data_port"
                               : "";
  return {ErrorCode::kUnreadable,
          fmt::format("{}:{}: {}: {}{}", address, port, what, std::strerror(error), fix)};
}

bool switch_on(int descriptor, int option) {
  const int on = 1;
  return setsockopt(descriptor, SOL_SOCKET, option, &on, sizeof(on)) == 0;
}

}  // namespace

Result<std::uint32_t> ipv4_address(const std::string& text) {
  in_addr address{};
  if (inet_pton(AF_INET, text.c_str(), &address) != 1) {
    return fail(ErrorCode::kMalformed,
                fmt::format("\"{}\" is not an IPv4 address such as 192.168.1.201", text));
  }
  return ntohl(address.s_addr);
}

Result<UdpReceiver> UdpReceiver::open(const std::string& address, std::uint16_t port,
                                      int buffer_bytes) {
  const auto host = ipv4_address(address);
  if (!host) return tl::make_unexpected(host.error());
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return tl::make_unexpected(socket_error(address, port, "no UDP socket"));
  UdpReceiver receiver(descriptor);
  // The force needs a privilege; without it the system's limit holds, which is a matter of how long
  // this thread may stall, not of whether it works.
  if (setsockopt(descriptor, SOL_SOCKET, SO_RCVBUFFORCE, &buffer_bytes, sizeof(buffer_bytes)) !=
      0) {
    setsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &buffer_bytes, sizeof(buffer_bytes));
  }
  if (!switch_on(descriptor, SO_TIMESTAMPNS) || !switch_on(descriptor, SO_RXQ_OVFL)) {
    return tl::make_unexpected(socket_error(address, port, "the kernel stamps no datagrams"));
  }
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_port = htons(port);
  name.sin_addr.s_addr = htonl(*host);
  if (bind(descriptor, reinterpret_cast<const sockaddr*>(&name), sizeof(name)) != 0) {
    return tl::make_unexpected(socket_error(address, port, "cannot be bound"));
  }
  return receiver;
}

UdpReceiver::UdpReceiver(int descriptor)
    : descriptor_(descriptor), batch_(std::make_unique<Batch>()) {}

UdpReceiver::UdpReceiver(UdpReceiver&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      batch_(std::move(other.batch_)),
      overflow_count_(other.overflow_count_),
      dropped_(other.dropped_) {}

UdpReceiver& UdpReceiver::operator=(UdpReceiver&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(batch_, other.batch_);
  overflow_count_ = other.overflow_count_;
  dropped_ = other.dropped_;
  return *this;
}

UdpReceiver::~UdpReceiver() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::span<const ReceivedDatagram> UdpReceiver::receive() {
  Batch& batch = *batch_;
  batch.prepare();  // the kernel has overwritten the lengths
  // With MSG_TRUNC the length is the datagram's own, however little was asked for.
  const int count =
      recvmmsg(descriptor_, batch.messages.data(), kBatch, MSG_DONTWAIT | MSG_TRUNC, nullptr);
  if (count <= 0) return {};
  const auto received = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < received; ++i) {
    ReceivedDatagram& datagram = batch.datagrams[i];
    datagram.stamp = std::chrono::nanoseconds(0);
    datagram.source = ntohl(batch.sources[i].sin_addr.s_addr);
    datagram.size = batch.messages[i].msg_len;
    datagram.payload = {batch.payloads[i].data(), std::min(datagram.size, kMaxPayload)};
    read_ancillary(batch.messages[i].msg_hdr, datagram);
  }
  return {batch.datagrams.data(), received};
}

void UdpReceiver::read_ancillary(msghdr& header, ReceivedDatagram& datagram) {
  for (cmsghdr* part = CMSG_FIRSTHDR(&header); part != nullptr; part = CMSG_NXTHDR(&header, part)) {
    if (part->cmsg_level != SOL_SOCKET) continue;
    if (part->cmsg_type == SO_TIMESTAMPNS) {
      std::timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(part), sizeof(stamp));
      datagram.stamp = std::chrono::seconds(stamp.tv_sec) + std::chrono::nanoseconds(stamp.tv_nsec);
    } else if (part->cmsg_type == SO_RXQ_OVFL) {
      // Counts from the socket's beginning, modulo 2^32.
      std::uint32_t count = 0;
      std::memcpy(&count, CMSG_DATA(part), sizeof(count));
      dropped_ += count - overflow_count_;
      overflow_count_ = count;
    }
  }
}

std::uint16_t UdpReceiver::port() const {
  sockaddr_in name{};
  socklen_t size = sizeof(name);
  if (getsockname(descriptor_, reinterpret_cast<sockaddr*>(&name), &size) != 0) return 0;
  return ntohs(name.sin_port);
}

int UdpReceiver::buffer_bytes() const {
  int bytes = 0;
  socklen_t size = sizeof(bytes);
  getsockopt(descriptor_, SOL_SOCKET, SO_RCVBUF, &bytes, &size);
  return bytes;
}

}  // namespace sparsight
