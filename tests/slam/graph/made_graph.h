#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "slam/graph/pose_graph.h"

namespace sparsight {

// Laps of a rounded way with a wavy floor, walked again and again: odometry between neighbours,
// loops back to the lap before, all with the noise that their information states; and false loops
// between any two nodes.
struct MadeGraph {
  struct Plan {
    std::size_t nodes = 400;
    std::size_t per_lap = 100;
    std::size_t loops = 60;
    std::size_t false_loops = 0;
    double sigma_rad = 0.002;
    double sigma_m = 0.01;
    std::uint32_t seed = 1;
  };

  PoseGraph graph;  // where odometry alone has the nodes
  std::vector<Eigen::Isometry3d> truth;
  std::size_t true_edges = 0;  // the false ones come after them

  explicit MadeGraph(const Plan& plan) : plan_(plan), random_(plan.seed) {
    for (std::size_t i = 0; i < plan.nodes; ++i) truth.push_back(place(i));
    graph.T_world_node.push_back(truth[0]);
    for (std::size_t i = 1; i < plan.nodes; ++i) {
      add(i - 1, i, truth[i - 1].inverse() * truth[i], false);
      graph.T_world_node.push_back(graph.T_world_node.back() * graph.edges.back().T_from_to);
    }
    for (std::size_t k = 0; k < plan.loops; ++k) {
      const std::size_t to = plan.per_lap + k * (plan.nodes - plan.per_lap) / plan.loops;
      add(to - plan.per_lap, to, truth[to - plan.per_lap].inverse() * truth[to], true);
    }
    true_edges = graph.edges.size();
    for (std::size_t k = 0; k < plan.false_loops; ++k) {
      const std::size_t from = random_() % plan.nodes;
      const std::size_t to = (from + 2 + random_() % (plan.nodes - 3)) % plan.nodes;
      Vector6d anywhere = 2.0 * draw();
      add(from, to, exp_se3(anywhere), true);
    }
  }

  // Root mean square distance from the truth; the first node is the same in both.
  double error_m(const PoseGraph& estimate) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      sum += (estimate.T_world_node[i].translation() - truth[i].translation()).squaredNorm();
    }
    return std::sqrt(sum / static_cast<double>(truth.size()));
  }

 private:
  Eigen::Isometry3d place(std::size_t i) const {
    const double turn = 2.0 * M_PI * static_cast<double>(i) / static_cast<double>(plan_.per_lap);
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = (Eigen::AngleAxisd(-turn, Eigen::Vector3d::UnitY()) *
                  Eigen::AngleAxisd(0.1 * std::sin(3.0 * turn), Eigen::Vector3d::UnitX()))
                     .toRotationMatrix();
    const double reach_m = static_cast<double>(plan_.per_lap) / (2.0 * M_PI);  // a metre a node
    T.translation() << reach_m * std::cos(turn), 0.3 * std::sin(2.0 * turn),
        0.6 * reach_m * std::sin(turn);
    return T;
  }

  // By hand: the standard's normal distribution differs from library to library.
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random_()) / 4294967296.0;
    return sum;
  }

  Vector6d draw() {
    Vector6d values;
    for (int i = 0; i < 6; ++i) values(i) = normal();
    return values;
  }

  void add(std::size_t from, std::size_t to, const Eigen::Isometry3d& T_from_to, bool loop) {
    Vector6d sigmas;
    sigmas << Eigen::Vector3d::Constant(plan_.sigma_rad), Eigen::Vector3d::Constant(plan_.sigma_m);
    const Vector6d noise = sigmas.cwiseProduct(draw());
    PoseEdge edge{.from = from, .to = to, .T_from_to = exp_se3(noise) * T_from_to, .loop = loop};
    edge.information = sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
    graph.edges.push_back(edge);
  }

  Plan plan_;
  std::mt19937 random_;
};

}  // namespace sparsight
