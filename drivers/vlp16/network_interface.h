#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace sparsight {

// The network interface by which packets to an IPv4 address would leave, as the routes are now; of
// an address of this machine's own, the one that has it. The first octet in the highest byte.
std::optional<std::string> interface_towards(std::uint32_t address);

}  // namespace sparsight
