#include "slam/graph/graph_optimizer.h"

#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/sized_cost_function.h>
#include <ceres/solver.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>

#include "slam/graph/connected_parts.h"
#include "slam/graph/dynamic_covariance_scaling.h"
#include "slam/graph/edge_error.h"

namespace sparsight {
namespace {

using RowMajor6x7 = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;

// A pose as Ceres moves it: quaternion (x, y, z, w), translation.
using Block = std::array<double, 7>;

Block block_of(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q(T.linear());
  const Eigen::Vector3d t = T.translation();
  return {q.x(), q.y(), q.z(), q.w(), t.x(), t.y(), t.z()};
}

Eigen::Isometry3d pose_of(const double* block) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Map<const Eigen::Quaterniond>(block).normalized().toRotationMatrix();
  T.translation() = Eigen::Map<const Eigen::Vector3d>(block + 4);
  return T;
}

// T <- T exp(eta). Jacobians are kept of eta alone, in the first six of the seven columns, so that
// this one only drops the seventh.
class BodyIncrement : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }  // NOLINT(readability-identifier-naming)
  int TangentSize() const override { return 6; }  // NOLINT(readability-identifier-naming)
  // NOLINTNEXTLINE(readability-identifier-naming)
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    const Block moved = block_of(pose_of(x) * exp_se3(Eigen::Map<const Vector6d>(delta)));
    std::ranges::copy(moved, x_plus_delta);
    return true;
  }
  // NOLINTNEXTLINE(readability-identifier-naming)
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>>(jacobian).setIdentity();
    return true;
  }
  // NOLINTNEXTLINE(readability-identifier-naming)
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    const Vector6d difference = log_se3(pose_of(x).inverse() * pose_of(y));
    std::ranges::copy(difference, y_minus_x);
    return true;
  }
  // NOLINTNEXTLINE(readability-identifier-naming)
  bool MinusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<RowMajor6x7>(jacobian).setIdentity();
    return true;
  }
};

// A with information = A^T A.
Matrix6d square_root(const Matrix6d& information) {
  const Eigen::LLT<Matrix6d> cholesky(information);
  if (cholesky.info() == Eigen::Success) return cholesky.matrixU();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(information);
  return eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         eigen.eigenvectors().transpose();
}

class EdgeCost : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  explicit EdgeCost(const PoseEdge& edge)
      : T_from_to_(edge.T_from_to), square_root_(square_root(edge.information)) {}

  // NOLINTNEXTLINE(readability-identifier-naming)
  bool Evaluate(double const* const* blocks, double* residual, double** jacobians) const override {
    const Vector6d error = edge_error(pose_of(blocks[0]), pose_of(blocks[1]), T_from_to_);
    Eigen::Map<Vector6d>(residual, 6) = square_root_ * error;
    if (jacobians == nullptr) return true;
    const EdgeJacobians J = edge_jacobians(error, T_from_to_);
    set(jacobians[0], J.d_error_d_from);
    set(jacobians[1], J.d_error_d_to);
    return true;
  }

 private:
  void set(double* jacobian, const Matrix6d& d_error) const {
    if (jacobian == nullptr) return;
    Eigen::Map<RowMajor6x7> J(jacobian);
    J.leftCols<6>() = square_root_ * d_error;
    J.col(6).setZero();
  }

  Eigen::Isometry3d T_from_to_;
  Matrix6d square_root_;
};

class DcsLoss : public ceres::LossFunction {
 public:
  explicit DcsLoss(double phi) : phi_(phi) {}
  // NOLINTNEXTLINE(readability-identifier-naming)
  void Evaluate(double chi2, double* rho) const override {
    const RobustCost cost = dcs_cost(chi2, phi_);
    rho[0] = cost.value;
    rho[1] = cost.first;
    rho[2] = cost.second;
  }

 private:
  double phi_;
};

// One node of every part that is connected, unless one is held already.
std::vector<std::size_t> anchors_of(const PoseGraph& graph) {
  const std::vector<std::size_t> part = connected_parts(graph);
  std::vector<bool> is_held(part.size(), false);
  for (const std::size_t node : graph.held) is_held[part[node]] = true;
  std::vector<std::size_t> anchors = graph.held;
  for (std::size_t node = 0; node < part.size(); ++node) {
    if (part[node] == node && !is_held[node]) anchors.push_back(node);
  }
  return anchors;
}

ceres::Solver::Options solver_options(const GraphOptimizerConfig& config) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  options.max_num_iterations = config.max_iterations;
  options.function_tolerance = config.relative_tolerance;
  options.gradient_tolerance = 0.0;  // in the units of the information, which are anyone's
  options.parameter_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  return options;
}

}  // namespace

GraphSummary optimize(PoseGraph& graph, const GraphOptimizerConfig& config) {
  std::vector<Block> blocks;
  blocks.reserve(graph.T_world_node.size());
  for (const Eigen::Isometry3d& T : graph.T_world_node) blocks.push_back(block_of(T));

  BodyIncrement manifold;
  DcsLoss dcs(config.dcs_phi);
  ceres::Problem::Options ownership;
  ownership.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(ownership);
  for (Block& block : blocks) problem.AddParameterBlock(block.data(), 7, &manifold);
  for (const PoseEdge& edge : graph.edges) {
    const bool robust = edge.loop && config.dcs_phi > 0.0;
    problem.AddResidualBlock(new EdgeCost(edge), robust ? &dcs : nullptr,  // Ceres takes it
                             blocks[edge.from].data(), blocks[edge.to].data());
  }
  for (const std::size_t node : anchors_of(graph)) {
    problem.SetParameterBlockConstant(blocks[node].data());
  }

  ceres::Solver::Summary summary;
  ceres::Solve(solver_options(config), &problem, &summary);
  if (summary.IsSolutionUsable()) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      graph.T_world_node[i] = pose_of(blocks[i].data());
    }
  }
  return {.initial_cost = 2.0 * summary.initial_cost,
          .final_cost = 2.0 * summary.final_cost,
          .iterations = summary.num_successful_steps + summary.num_unsuccessful_steps,
          .converged = summary.termination_type == ceres::CONVERGENCE};
}

double graph_cost(const PoseGraph& graph, double dcs_phi) {
  double cost = 0.0;
  for (const PoseEdge& edge : graph.edges) {
    const double chi2 = edge_chi2(graph, edge);
    cost += edge.loop && dcs_phi > 0.0 ? dcs_cost(chi2, dcs_phi).value : chi2;
  }
  return cost;
}

double impossible_chi2(const PoseGraph& graph) {
  // Of chi^2 with six degrees of freedom: the median, and what one in 100,000 exceeds.
  constexpr double kMedian = 5.348;
  constexpr double kNever = 33.1;
  // Where a few loops are all there is, they may not judge themselves.
  constexpr std::size_t kEnoughToJudge = 10;
  std::vector<double> chi2;
  for (const PoseEdge& edge : graph.edges) {
    if (edge.loop) chi2.push_back(edge_chi2(graph, edge));
  }
  if (chi2.size() < kEnoughToJudge) return kNever;
  const auto middle = chi2.begin() + static_cast<std::ptrdiff_t>(chi2.size() / 2);
  std::ranges::nth_element(chi2, middle);
  return kNever * std::max(1.0, *middle / kMedian);
}

std::vector<std::size_t> contradicted_loops(const PoseGraph& graph) {
  const double impossible = impossible_chi2(graph);
  std::vector<std::size_t> contradicted;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const PoseEdge& edge = graph.edges[i];
    if (edge.loop && edge_chi2(graph, edge) > impossible) contradicted.push_back(i);
  }
  return contradicted;
}

}  // namespace sparsight
