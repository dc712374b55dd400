#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>

namespace sparsight::testing {

// A sensor's network card: sends datagrams on the loopback interface, from an address of it.
class LoopbackSender {
 public:
  explicit LoopbackSender(const char* address = "127.0.0.1")
      : socket_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    const sockaddr_in name = name_of(address, 0);
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&name), sizeof(name)), 0);
  }
  ~LoopbackSender() { close(socket_); }
  LoopbackSender(const LoopbackSender&) = delete;
  LoopbackSender& operator=(const LoopbackSender&) = delete;

  template <typename Bytes>
  void send(std::uint16_t port, const Bytes& bytes) const {
    const sockaddr_in name = name_of("127.0.0.1", port);
    EXPECT_EQ(sendto(socket_, bytes.data(), bytes.size(), 0,
                     reinterpret_cast<const sockaddr*>(&name), sizeof(name)),
              static_cast<ssize_t>(bytes.size()));
  }

 private:
  static sockaddr_in name_of(const char* address, std::uint16_t port) {
    sockaddr_in name{};
    name.sin_family = AF_INET;
    name.sin_port = htons(port);
    inet_pton(AF_INET, address, &name.sin_addr);
    return name;
  }
  int socket_;
};

}  // namespace sparsight::testing
