#pragma once

#include <string>

#include "tools/doctor/check.h"
#include "tools/doctor/edge_alignment.h"

namespace sparsight {

// Whether the calibration puts the LiDAR's edges onto those of the images. `overlay` is the picture
// that shows it; "" if there is none.
Check alignment_check(const EdgeAlignmentReport& seen, const std::string& overlay);

}  // namespace sparsight
