#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

#include "hal/result.h"
#include "slam/graph/graph_optimizer.h"

namespace sparsight {

struct OptimiseOptions {
  std::string input;   // g2o file
  std::string output;  // g2o file; "" for none
  GraphOptimizerConfig optimizer{.max_iterations = 100, .relative_tolerance = 1e-9};
};

struct OptimiseReport {
  std::size_t vertices = 0;
  std::size_t edges = 0;
  std::size_t loops = 0;
  std::vector<std::string> taken_out;  // "FROM TO", as the file names them
  double initial_cost = 0.0;           // sum of chi^2
  double final_cost = 0.0;
  int iterations = 0;
  bool converged = false;
  std::chrono::nanoseconds time{};  // without reading and writing
};

Result<OptimiseReport> optimise_graph(const OptimiseOptions& options);

std::string optimise_text(const OptimiseReport& report);
std::string optimise_json(const OptimiseReport& report);

}  // namespace sparsight
