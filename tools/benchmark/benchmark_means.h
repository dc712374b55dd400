#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tools/benchmark/benchmark.h"
#include "tools/benchmark/published_results.h"

namespace sparsight {

// Whether a run can stand beside the paper's: the whole sequence, in segments of 100 ... 800 m.
bool is_comparable(const BenchmarkEntry& entry);

// Arithmetic mean over the sequences whose run with this number of rays is comparable, as the
// paper's own average (not KITTI's, which weighs by segments).
struct RaysMean {
  int rays = 0;
  std::size_t sequences = 0;
  double t_rel_percent = 0.0;
  double r_rel_deg_per_m = 0.0;
};
std::vector<RaysMean> means_by_rays(const Benchmark& benchmark);

// The mean of the paper's rows for the sequences that have a comparable run.
struct PublishedMean {
  std::size_t sequences = 0;
  PublishedErrors errors{};
};
PublishedMean published_mean(const Benchmark& benchmark);

// Names of the sequences, each once, in order.
std::vector<std::string> sequence_names(const Benchmark& benchmark);
const BenchmarkEntry* find_entry(const Benchmark& benchmark, const std::string& sequence, int rays);

}  // namespace sparsight
