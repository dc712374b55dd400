#pragma once

#include <cstdint>

#include "drivers/recording/bytes.h"

namespace sparsight {

// The CRC of MCAP: polynomial 0x04c11db7 reflected, as in zlib. `before` is that of what precedes.
std::uint32_t crc32_of(Bytes bytes, std::uint32_t before = 0);

// Of two parts put together, from the CRC of each and the length of the second.
std::uint32_t crc32_of_both(std::uint32_t first, std::uint32_t second, std::uint64_t second_size);

}  // namespace sparsight
