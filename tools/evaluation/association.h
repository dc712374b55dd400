#pragma once

#include <chrono>
#include <cstddef>
#include <vector>

#include "hal/result.h"
#include "tools/evaluation/trajectory.h"

namespace sparsight {

// Poses no further apart than this are of the same instant.
inline constexpr std::chrono::nanoseconds kSimultaneous{20'000'000};

struct IndexPair {
  std::size_t estimate = 0;
  std::size_t truth = 0;
};

// Pairs poses that are each other's nearest in time and no further apart than the tolerance: one to
// one, in order. Stricter than the greedy matching of the TUM scripts, which gives a pose its
// second choice when a closer pose took the first.
std::vector<IndexPair> associate_by_time(const std::vector<HostTime>& estimate,
                                         const std::vector<HostTime>& truth,
                                         std::chrono::nanoseconds tolerance);

// By time if both have times, by index if neither has; an error if only one has, or nothing pairs.
Result<std::vector<IndexPair>> associate(const Trajectory& estimate, const Trajectory& truth,
                                         std::chrono::nanoseconds tolerance);

}  // namespace sparsight
