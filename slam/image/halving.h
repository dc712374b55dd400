#pragma once

#include <cstdint>

namespace sparsight {

// Means of 2x2 pixels, rounded, out of two rows of 2 * width each. Vectorised for the machine at
// hand. Real-time-safe.
void halve_rows(const std::uint8_t* upper, const std::uint8_t* lower, int width, std::uint8_t* out);

}  // namespace sparsight
