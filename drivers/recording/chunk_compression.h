#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "drivers/recording/bytes.h"

namespace sparsight {

// How the chunks of a recording are packed; the fast settings of each, as a recorder shares its
// cores with the estimation.
enum class Compression : std::uint8_t { kNone, kLz4, kZstd };

// As MCAP writes it: "", "lz4", "zstd"; nothing for a name that is none of these.
std::string_view mcap_name(Compression compression);
std::optional<Compression> compression_of(std::string_view mcap_name);

// Replaces `out`. For kNone use the bytes as they are.
void compress(Compression compression, Bytes bytes, std::vector<std::uint8_t>& out);

// Replaces `out` with what the bytes hold, which may have been cut off: false if they end early or
// are damaged, and `out` then holds what came before. Never more than `limit` bytes, whatever the
// data promise: one byte more than the limit is damage, too.
bool decompress(Compression compression, Bytes bytes, std::uint64_t limit,
                std::vector<std::uint8_t>& out);

}  // namespace sparsight
