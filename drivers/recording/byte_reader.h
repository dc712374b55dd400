#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "drivers/recording/bytes.h"

namespace sparsight {

static_assert(std::endian::native == std::endian::little, "MCAP and our CDR are little-endian");

// Values out of bytes nobody vouches for. What lies past the end reads as zero or empty, and ok()
// is false from then on, so that a whole record is read first and checked once.
class ByteReader {
 public:
  explicit ByteReader(Bytes bytes) : bytes_(bytes) {}

  template <typename T>
  T number() {
    static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool>);
    T value{};
    const Bytes taken = take(sizeof(T));
    if (!taken.empty()) std::memcpy(&value, taken.data(), sizeof(T));
    return value;
  }

  Bytes take(std::uint64_t count) {
    if (count > left()) {
      ok_ = false;
      bytes_ = {};
      return {};
    }
    const Bytes taken = bytes_.first(count);
    bytes_ = bytes_.subspan(count);
    return taken;
  }

  // With its length in 32 bits before it, as MCAP writes text and maps.
  Bytes prefixed() { return take(number<std::uint32_t>()); }
  std::string_view text() { return text_of(prefixed()); }

  std::size_t left() const { return bytes_.size(); }
  bool ok() const { return ok_; }

 private:
  Bytes bytes_;
  bool ok_ = true;
};

}  // namespace sparsight
