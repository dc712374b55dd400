#include "tools/graph/optimise_graph.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hal/time.h"
#include "slam/graph/cold_solution.h"
#include "tools/evaluation/text_file.h"
#include "tools/graph/g2o_file.h"
#include "tools/session/atomic_file.h"

namespace sparsight {

Result<OptimiseReport> optimise_graph(const OptimiseOptions& options) {
  const Result<std::string> text = read_text_file(options.input);
  if (!text) return tl::unexpected(text.error());
  Result<G2oGraph> file = parse_g2o(*text, options.input);
  if (!file) return tl::unexpected(file.error());

  const auto begin = std::chrono::steady_clock::now();
  ColdSolution solution = solve_from_cold(file->graph, options.optimizer);
  const auto time = std::chrono::steady_clock::now() - begin;

  OptimiseReport report{.vertices = file->ids.size(),
                        .edges = file->graph.edges.size(),
                        .initial_cost = solution.initial_cost,
                        .final_cost = solution.final_cost,
                        .iterations = solution.iterations,
                        .converged = solution.converged,
                        .time = time};
  report.loops =
      static_cast<std::size_t>(std::ranges::count(file->graph.edges, true, &PoseEdge::loop));
  for (const std::size_t edge : solution.taken_out) {
    const PoseEdge& out = file->graph.edges[edge];
    report.taken_out.push_back(fmt::format("{} {}", file->ids[out.from], file->ids[out.to]));
  }
  file->graph.T_world_node = std::move(solution.graph.T_world_node);
  if (!options.output.empty()) {
    const auto written = write_file(options.output, format_g2o(*file, solution.taken_out));
    if (!written) return tl::unexpected(written.error());
  }
  return report;
}

std::string optimise_text(const OptimiseReport& report) {
  std::string text = fmt::format(
      "graph       {} vertices, {} edges, {} of them loops\n"
      "cost        {:.6g} -> {:.6f} (sum of chi^2{})\n"
      "iterations  {} in {:.3f} s, {}\n",
      report.vertices, report.edges, report.loops, report.initial_cost, report.final_cost,
      report.taken_out.empty() ? "" : "; the last without the loops taken out", report.iterations,
      to_seconds(report.time), report.converged ? "converged" : "not converged");
  if (!report.taken_out.empty()) {
    text += fmt::format("taken out   {} loops that the rest contradicts: {}\n",
                        report.taken_out.size(), fmt::join(report.taken_out, ", "));
  }
  return text;
}

std::string optimise_json(const OptimiseReport& report) {
  const nlohmann::ordered_json json = {
      {"vertices", report.vertices},     {"edges", report.edges},
      {"loops", report.loops},           {"initial_cost", report.initial_cost},
      {"final_cost", report.final_cost}, {"iterations", report.iterations},
      {"converged", report.converged},   {"seconds", to_seconds(report.time)},
      {"taken_out", report.taken_out}};
  return json.dump(2) + "\n";
}

}  // namespace sparsight
