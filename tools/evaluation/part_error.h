#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "hal/time.h"
#include "tools/evaluation/session_loops.h"
#include "tools/evaluation/trajectory.h"

namespace sparsight {

// From each time on the pose belongs to that part, until the next time.
using PartsOfTime = std::map<HostTime, std::uint64_t>;

// The session's sub-maps, or what loops have joined of them.
PartsOfTime submaps_of_time(const SessionLoops& session);
PartsOfTime joined_parts_of_time(const SessionLoops& session);

// Absolute error (root mean square) of a path in parts of which nobody knows how they stand to each
// other: each is moved rigidly onto the truth for itself. None: nothing to compare.
std::optional<double> part_error_m(const Trajectory& estimate, const Trajectory& truth,
                                   const PartsOfTime& parts);

}  // namespace sparsight
