#pragma once

#include <string>

#include "tools/benchmark/benchmark.h"

namespace sparsight {

// For people, as Markdown that reads in a terminal too: t_rel beside the paper's Table II, then
// r_rel, ATE and time, then what must be known to read them. `command` is how it was called.
std::string benchmark_markdown(const Benchmark& benchmark, const std::string& command);

// For machines. The keys are stable; a figure that could not be computed is null:
//   sparsight, command, profile, max_frames, complete, notes [text]
//   runs [{ sequence, rays, status ("done", "failed", "not run"), message, session, frames,
//           truth_frames, path_length_m, comparable, lengths_m [m], t_rel_percent,
//           r_rel_deg_per_m, ate_rmse_m, tracking_median_ms, tracking_p99_ms, times_real_time }]
//   means [{ rays, sequences, t_rel_percent, r_rel_deg_per_m }]: of the comparable runs
//   published [{ sequence, demo, dvl_64, dvl_16, dvl_8 }]: t_rel_percent in the paper
// A run is comparable with the paper if it covers the whole ground truth in segments of 100-800 m.
std::string benchmark_json(const Benchmark& benchmark, const std::string& command);

}  // namespace sparsight
