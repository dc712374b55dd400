#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>

namespace sparsight {

enum class ErrorCode : std::uint8_t {
  kNotFound,      // a file or folder that must be there is not
  kUnreadable,    // it is there, and the system refused to read or write it
  kMalformed,     // its bytes do not follow its format
  kMissingField,  // a required field is absent
  kOutOfRange,    // a value is outside what the field allows
  kWrongSize,     // a size disagrees with what was announced
};

// What a person is told: the file, the line or field, and the fix. For files and tools; code that
// decodes wire data returns a bare code instead, as it must not allocate.
struct Error {
  ErrorCode code;
  std::string message;
};

template <typename T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(ErrorCode code, std::string message) {
  return tl::unexpected<Error>(Error{code, std::move(message)});
}

}  // namespace sparsight
