#include "drivers/vlp16/network_interface.h"

#include <ifaddrs.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace sparsight {
namespace {

// Connecting a UDP socket sends nothing; it only chooses this end.
std::optional<std::uint32_t> own_address_towards(std::uint32_t address) {
  const int descriptor = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return std::nullopt;
  sockaddr_in name{};
  name.sin_family = AF_INET;
  name.sin_port = htons(9);
  name.sin_addr.s_addr = htonl(address);
  socklen_t size = sizeof(name);
  auto* const any = reinterpret_cast<sockaddr*>(&name);
  const bool known =
      connect(descriptor, any, sizeof(name)) == 0 && getsockname(descriptor, any, &size) == 0;
  close(descriptor);
  if (!known) return std::nullopt;
  return ntohl(name.sin_addr.s_addr);
}

}  // namespace

std::optional<std::string> interface_towards(std::uint32_t address) {
  const auto own = own_address_towards(address);
  ifaddrs* interfaces = nullptr;
  if (!own || getifaddrs(&interfaces) != 0) return std::nullopt;
  std::optional<std::string> found;
  for (const ifaddrs* at = interfaces; at != nullptr && !found; at = at->ifa_next) {
    if (at->ifa_addr == nullptr || at->ifa_addr->sa_family != AF_INET) continue;
    const auto* has = reinterpret_cast<const sockaddr_in*>(at->ifa_addr);
    if (ntohl(has->sin_addr.s_addr) == *own) found = at->ifa_name;
  }
  freeifaddrs(interfaces);
  return found;
}

}  // namespace sparsight
