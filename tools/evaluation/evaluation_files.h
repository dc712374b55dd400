#pragma once

#include <filesystem>
#include <optional>

#include "hal/result.h"
#include "tools/evaluation/evaluation.h"

namespace sparsight {

// What `sparsight evaluate` was given.
struct EvaluationFiles {
  std::filesystem::path estimate;  // a trajectory, or a session folder
  std::filesystem::path truth;
  std::optional<std::filesystem::path> times;  // of KITTI files, where the other one has times
  std::optional<TrajectoryFormat> format;      // of the estimate; told by its content if absent
};

// The trajectory a session folder holds, in the ground truth's format where it has both.
Result<std::filesystem::path> trajectory_in_session(const std::filesystem::path& folder,
                                                    TrajectoryFormat preferred);

struct TrajectoryPair {
  Trajectory estimate;
  Trajectory truth;
};

// Reads both, and gives times to those without if there is a file of times.
Result<TrajectoryPair> read_trajectories(const EvaluationFiles& files);

}  // namespace sparsight
