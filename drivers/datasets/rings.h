#pragma once

#include <cstddef>
#include <vector>

#include "hal/sweep.h"

namespace sparsight {

// Gives each return of a stored scan its ring (LidarReturn::ring, counted from 0 in the order of
// storage) and brings the returns into the order hal/sweep.h asks for. Returns the ring count.
std::size_t assign_rings(std::vector<LidarReturn>& returns);

// Keeps `wanted` of the rings, evenly: ring floor(k * ring_count / wanted) for each k. A scan with
// no more rings than that is left whole.
void keep_rings(std::vector<LidarReturn>& returns, std::size_t ring_count, std::size_t wanted);

}  // namespace sparsight
