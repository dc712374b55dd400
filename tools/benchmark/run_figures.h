#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "hal/result.h"
#include "tools/benchmark/replay_run.h"
#include "tools/evaluation/evaluation.h"

namespace sparsight {

struct RunAccuracy {
  Evaluation evaluation;
  std::vector<double> lengths_m;  // of the segments
  bool short_segments = false;    // too short a path for 100 m: 10 ... 50 m instead
};

// What a finished session says.
struct RunFigures {
  std::size_t frames = 0;
  std::optional<RunAccuracy> accuracy;  // none: no ground truth
  std::optional<double> tracking_median_ms;
  std::optional<double> tracking_p99_ms;
  std::optional<double> times_real_time;
};

// Reads the session of a finished run and compares it with the sequence's ground truth.
Result<RunFigures> read_run_figures(const ReplayRun& run);

}  // namespace sparsight
