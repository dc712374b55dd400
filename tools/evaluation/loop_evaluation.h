#pragma once

#include <filesystem>
#include <optional>

#include "hal/result.h"
#include "tools/evaluation/loop_error.h"
#include "tools/evaluation/trajectory.h"

namespace sparsight {

// A session's loops, and its path without and with them: sub-maps and what loops have made of them,
// each for itself. No errors of paths where the truth has no times.
struct LoopEvaluation {
  LoopError loops;
  std::optional<double> odometry_ate_m;
  std::optional<double> ate_m;
};

Result<LoopEvaluation> evaluate_loops(const std::filesystem::path& session_folder,
                                      const Trajectory& truth);

}  // namespace sparsight
