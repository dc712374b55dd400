#include <benchmark/benchmark.h>

#include "slam/graph/graph_optimizer.h"
#include "tests/slam/graph/made_graph.h"

namespace sparsight {
namespace {

// A loop comes to a graph that was optimised before: 10,000 keyframes and 500 loops when it is
// there.
void warm_update(benchmark::State& state) {
  MadeGraph made({.nodes = static_cast<std::size_t>(state.range(0)),
                  .per_lap = static_cast<std::size_t>(state.range(0)) / 8,
                  .loops = static_cast<std::size_t>(state.range(1))});
  // The newest loop is of the lap before the last: what it says reaches far.
  const std::size_t middle = made.graph.edges.size() - static_cast<std::size_t>(state.range(1)) / 2;
  const PoseEdge newest = made.graph.edges[middle];
  PoseGraph before = made.graph;
  before.edges.erase(before.edges.begin() + static_cast<std::ptrdiff_t>(middle));
  optimize(before, {.dcs_phi = 0.0});
  optimize(before, {});
  before.edges.push_back(newest);
  GraphSummary summary;
  for (auto _ : state) {
    PoseGraph graph = before;
    summary = optimize(graph, {});
    benchmark::DoNotOptimize(contradicted_loops(graph));
  }
  state.counters["iterations"] = summary.iterations;
}
BENCHMARK(warm_update)
    ->ArgNames({"keyframes", "loops"})
    ->Args({1000, 50})
    ->Args({10000, 500})
    ->Unit(benchmark::kMillisecond);

// From where odometry alone has the keyframes.
void cold_solution(benchmark::State& state) {
  const MadeGraph made({.nodes = 10000, .per_lap = 1250, .loops = 500});
  GraphSummary summary;
  for (auto _ : state) {
    PoseGraph graph = made.graph;
    summary = optimize(graph, {.dcs_phi = 0.0});
  }
  state.counters["iterations"] = summary.iterations;
}
BENCHMARK(cold_solution)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sparsight
