#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <vector>

#include "drivers/recording/bytes.h"

namespace sparsight {

static_assert(std::endian::native == std::endian::little, "MCAP and our CDR are little-endian");

// Appends values to bytes, as MCAP writes them.
class ByteWriter {
 public:
  explicit ByteWriter(std::vector<std::uint8_t>& out) : out_(&out) {}

  template <typename T>
  void number(T value) {
    static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
    std::uint8_t raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    out_->insert(out_->end(), raw, raw + sizeof(T));
  }
  void bytes(Bytes bytes) { out_->insert(out_->end(), bytes.begin(), bytes.end()); }
  void text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    bytes(bytes_of(text));
  }

  std::size_t position() const { return out_->size(); }
  // Overwrites a number written before, such as a length that is known only now.
  template <typename T>
  void patch(std::size_t position, T value) {
    std::memcpy(out_->data() + position, &value, sizeof(T));
  }

 private:
  std::vector<std::uint8_t>* out_;
};

}  // namespace sparsight
