#include "slam/loop/loop_graph.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "slam/graph/connected_parts.h"
#include "slam/graph/edge_error.h"

namespace sparsight {
namespace {

constexpr int kIterations = 20;
// Of a true loop: chi^2 with six degrees of freedom, which one in 100,000 exceeds.
constexpr double kHighestPrice = 33.1;

// The loop of those that the graph contradicts most.
std::size_t worst_of(const PoseGraph& graph, const std::vector<std::size_t>& loops) {
  return *std::ranges::max_element(
      loops, {}, [&](std::size_t edge) { return edge_chi2(graph, graph.edges[edge]); });
}

// Moves the part with the younger first node to where the loop has it in the other.
void move_onto_other(PoseGraph& graph, const std::vector<std::size_t>& part, const PoseEdge& loop) {
  const Eigen::Isometry3d T_world_from = graph.T_world_node[loop.from];
  const Eigen::Isometry3d T_world_to = graph.T_world_node[loop.to];
  const bool from_moves = part[loop.from] > part[loop.to];
  const Eigen::Isometry3d T_after_before =
      from_moves ? T_world_to * loop.T_from_to.inverse() * T_world_from.inverse()
                 : T_world_from * loop.T_from_to * T_world_to.inverse();
  const std::size_t moving = part[from_moves ? loop.from : loop.to];
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (part[i] != moving) continue;
    graph.T_world_node[i] = renormalized(T_after_before * graph.T_world_node[i]);
  }
}

bool same_loop(const PoseEdge& a, const PoseEdge& b) {
  return a.loop && b.loop && a.from == b.from && a.to == b.to;
}

}  // namespace

void LoopGraph::resume(PoseGraph graph) {
  graph_ = std::move(graph);
  part_ = connected_parts(graph_);
}

void LoopGraph::begin_submap(const Eigen::Isometry3d& T_world_keyframe) {
  part_.push_back(graph_.T_world_node.size());
  graph_.T_world_node.push_back(T_world_keyframe);
}

void LoopGraph::add_next(const Eigen::Isometry3d& T_last_next, const Matrix6d& information) {
  const std::size_t last = graph_.T_world_node.size() - 1;
  graph_.T_world_node.push_back(renormalized(graph_.T_world_node[last] * T_last_next));
  graph_.edges.push_back(
      {.from = last, .to = last + 1, .T_from_to = T_last_next, .information = information});
  part_.push_back(part_[last]);
}

bool LoopGraph::add_loop(std::size_t from, std::size_t to, const Eigen::Isometry3d& T_from_to,
                         const Matrix6d& information) {
  const PoseEdge loop{
      .from = from, .to = to, .T_from_to = T_from_to, .information = information, .loop = true};
  const GraphOptimizerConfig robust{.max_iterations = kIterations, .dcs_phi = dcs_phi_};
  PoseGraph warm = graph_;
  warm.edges.push_back(loop);
  // As if it were true: after a long way the drift may exceed what the scaling lets a loop pull.
  last_ = optimize(warm, {.max_iterations = kIterations, .dcs_phi = 0.0});
  if (last_.final_cost - graph_cost(graph_, 0.0) > kHighestPrice) return false;
  last_ = optimize(warm, robust);
  for (auto against = contradicted_loops(warm); !against.empty();
       against = contradicted_loops(warm)) {
    const std::size_t worst = worst_of(warm, against);
    if (worst + 1 == warm.edges.size()) return false;
    warm.edges.erase(warm.edges.begin() + static_cast<std::ptrdiff_t>(worst));
    last_ = optimize(warm, robust);
  }
  graph_ = std::move(warm);
  part_ = connected_parts(graph_);  // which may be more, if loops were taken out
  return true;
}

bool LoopGraph::join(std::span<const PoseEdge> loops) {
  PoseGraph joined = graph_;
  move_onto_other(joined, part_, loops.front());
  const double before = graph_cost(joined, 0.0);
  joined.edges.insert(joined.edges.end(), loops.begin(), loops.end());
  last_ = optimize(joined, {.max_iterations = kIterations, .dcs_phi = 0.0});
  const auto judged = static_cast<double>(loops.size() - 1);
  if (loops.size() < 2 || last_.final_cost - before > judged * kHighestPrice) return false;
  last_ = optimize(joined, {.max_iterations = kIterations, .dcs_phi = dcs_phi_});
  if (!contradicted_loops(joined).empty()) return false;
  graph_ = std::move(joined);
  part_ = connected_parts(graph_);
  return true;
}

bool LoopGraph::has(const PoseEdge& loop) const {
  return std::ranges::any_of(graph_.edges,
                             [&](const PoseEdge& edge) { return same_loop(edge, loop); });
}

LoopGraph LoopGraph::without(std::span<const PoseEdge> loops) const {
  LoopGraph rest = *this;
  std::erase_if(rest.graph_.edges, [&](const PoseEdge& edge) {
    return std::ranges::any_of(loops, [&](const PoseEdge& loop) { return same_loop(edge, loop); });
  });
  rest.last_ = optimize(rest.graph_, {.max_iterations = kIterations, .dcs_phi = dcs_phi_});
  rest.part_ = connected_parts(rest.graph_);
  return rest;
}

}  // namespace sparsight
