#pragma once

namespace sparsight {

// What a number in a file may be. Both ends belong to the range.
struct FieldRange {
  double min;
  double max;
};

inline constexpr FieldRange kShare{0.0, 1.0};

}  // namespace sparsight
