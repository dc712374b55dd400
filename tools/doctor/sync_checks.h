#pragma once

#include <vector>

#include "realtime/sync/synchronizer.h"
#include "tools/doctor/check.h"

namespace sparsight {

// Edges matched to frames, the camera's delay and the LiDAR's clock with their spread.
std::vector<Check> sync_checks(const SyncState& state);

}  // namespace sparsight
