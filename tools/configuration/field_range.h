#pragma once

#include <string>
#include <string_view>

namespace sparsight {

// What a number in a file may be. Both ends belong to the range.
struct FieldRange {
  double min;
  double max;
};

inline constexpr FieldRange kShare{0.0, 1.0};

// What a text in a file may be.
struct TextRule {
  bool (*accepts)(std::string_view text);
  std::string expected;  // "must be ..." says an error
};

}  // namespace sparsight
