#include "slam/graph/chordal_start.h"

#include <Eigen/SVD>
#include <Eigen/SparseCholesky>
#include <utility>

#include "slam/graph/connected_parts.h"

namespace sparsight {
namespace {

using Triplets = std::vector<Eigen::Triplet<double>>;
constexpr double kFaintHold = 1e-9;  // keeps nodes that no edge reaches solvable

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& M) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0.0) U.col(2) *= -1.0;
  return U * svd.matrixV().transpose();
}

// An isotropic weight for rotation and translation, as the linear problems need it.
std::pair<double, double> weights_of(const PoseEdge& edge) {
  return {edge.information.topLeftCorner<3, 3>().trace() / 3.0,
          edge.information.bottomRightCorner<3, 3>().trace() / 3.0};
}

Eigen::MatrixXd solve(const Triplets& entries, const Eigen::MatrixXd& right_side) {
  Eigen::SparseMatrix<double> A(right_side.rows(), right_side.rows());
  A.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> cholesky(A);
  return cholesky.solve(right_side);
}

void add_block(Triplets& entries, std::size_t row, std::size_t column, const Eigen::Matrix3d& B) {
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      entries.emplace_back(static_cast<int>(3 * row) + r, static_cast<int>(3 * column) + c,
                           B(r, c));
    }
  }
}

// Columns of X are the rows of the rotations: X_to = Z^T X_from, for all three rows at once.
void relax_rotations(PoseGraph& graph, const std::vector<std::size_t>& first) {
  const std::size_t nodes = graph.T_world_node.size();
  Triplets entries;
  Eigen::MatrixXd right_side = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * nodes), 3);
  for (const PoseEdge& edge : graph.edges) {
    const double weight = weights_of(edge).first;
    const Eigen::Matrix3d Z = edge.T_from_to.linear();
    add_block(entries, edge.from, edge.from, weight * Eigen::Matrix3d::Identity());
    add_block(entries, edge.to, edge.to, weight * Eigen::Matrix3d::Identity());
    add_block(entries, edge.from, edge.to, -weight * Z);
    add_block(entries, edge.to, edge.from, -weight * Z.transpose());
  }
  for (std::size_t node = 0; node < nodes; ++node) {
    const double hold = first[node] == node ? 1e3 : kFaintHold;
    add_block(entries, node, node, hold * Eigen::Matrix3d::Identity());
    right_side.block<3, 3>(static_cast<Eigen::Index>(3 * node), 0) =
        hold * graph.T_world_node[node].linear().transpose();
  }
  const Eigen::MatrixXd X = solve(entries, right_side);
  for (std::size_t node = 0; node < nodes; ++node) {
    const Eigen::Matrix3d M = X.block<3, 3>(static_cast<Eigen::Index>(3 * node), 0).transpose();
    if (first[node] != node) graph.T_world_node[node].linear() = nearest_rotation(M);
  }
}

void place(PoseGraph& graph, const std::vector<std::size_t>& first) {
  const auto nodes = static_cast<Eigen::Index>(graph.T_world_node.size());
  Triplets entries;
  Eigen::MatrixXd right_side = Eigen::MatrixXd::Zero(nodes, 3);
  for (const PoseEdge& edge : graph.edges) {
    const double weight = weights_of(edge).second;
    const auto from = static_cast<int>(edge.from);
    const auto to = static_cast<int>(edge.to);
    const Eigen::RowVector3d shift =
        (graph.T_world_node[edge.from].linear() * edge.T_from_to.translation()).transpose();
    entries.emplace_back(from, from, weight);
    entries.emplace_back(to, to, weight);
    entries.emplace_back(from, to, -weight);
    entries.emplace_back(to, from, -weight);
    right_side.row(to) += weight * shift;
    right_side.row(from) -= weight * shift;
  }
  for (std::size_t node = 0; node < graph.T_world_node.size(); ++node) {
    const double hold = first[node] == node ? 1e6 : kFaintHold;
    const auto row = static_cast<int>(node);
    entries.emplace_back(row, row, hold);
    right_side.row(row) += hold * graph.T_world_node[node].translation().transpose();
  }
  const Eigen::MatrixXd X = solve(entries, right_side);
  for (Eigen::Index node = 0; node < nodes; ++node) {
    graph.T_world_node[static_cast<std::size_t>(node)].translation() = X.row(node).transpose();
  }
}

}  // namespace

PoseGraph chordal_start(PoseGraph graph) {
  if (graph.T_world_node.empty()) return graph;
  const std::vector<std::size_t> first = connected_parts(graph);
  relax_rotations(graph, first);
  place(graph, first);
  return graph;
}

}  // namespace sparsight
