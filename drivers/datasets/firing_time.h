#pragma once

#include <vector>

#include "hal/sweep.h"
#include "hal/time.h"

namespace sparsight {

// One turn of the scanner, from straight back to straight back.
struct SweepTiming {
  HostTime start;
  HostTime end;
};

// Sets from_exposure_ns of each return. Seen from above the HDL-64E spins clockwise, so time runs
// against the azimuth atan2(y, x): the turn starts facing back (+180 degrees), faces forward at
// half time and ends facing back (-180 degrees).
void stamp_returns(std::vector<LidarReturn>& returns, const SweepTiming& sweep, HostTime exposure);

}  // namespace sparsight
