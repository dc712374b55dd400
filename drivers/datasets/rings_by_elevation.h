#pragma once

#include <cstdint>
#include <vector>

#include "drivers/datasets/scan_angles.h"

namespace sparsight {

// The ring of each return from its elevation alone, counted from the top: for scans in the order of
// firing, or in none.
std::vector<std::uint16_t> rings_by_elevation(const ScanAngles& angles);

}  // namespace sparsight
