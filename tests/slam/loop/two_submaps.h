#pragma once

#include <gtest/gtest.h>

#include "slam/loop/join_evidence.h"

namespace sparsight {

constexpr std::size_t kKeyframes = 20;  // of each sub-map, a metre apart

inline Eigen::Isometry3d at(double x, double y = 0.0) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, 0.0));
}

// The same way walked twice, and what came between is not known: the second sub-map stands a
// hundred metres off, turned by a right angle.
class TwoSubmaps : public ::testing::Test {
 protected:
  TwoSubmaps() {
    for (std::size_t i = 0; i < kKeyframes; ++i) {
      i == 0 ? graph.begin_submap(at(0.0)) : graph.add_next(at(1.0), information());
    }
    for (std::size_t i = 0; i < kKeyframes; ++i) {
      i == 0 ? graph.begin_submap(at(100.0) * Eigen::AngleAxisd(M_PI_2, Eigen::Vector3d::UnitZ()))
             : graph.add_next(at(1.0), information());
    }
  }

  static Matrix6d information() {
    Matrix6d result = Matrix6d::Zero();
    result.diagonal() << Eigen::Vector3d::Constant(1e6), Eigen::Vector3d::Constant(1e4);
    return result;
  }

  // From the second sub-map's view `i` to the first one's view `i + ahead`, though it may be that
  // it only looks like that.
  static SeenAgain loop(std::size_t i, std::size_t ahead = 0, double off_m = 0.0) {
    SeenAgain seen{.current = kKeyframes + i, .candidate = i + ahead};
    seen.check.T_current_candidate = at(static_cast<double>(ahead) + off_m);
    seen.check.information = information();
    seen.check.pose_inliers = 200;
    seen.check.found_share = 0.9;
    return seen;
  }

  LoopGraph graph{12.6};
  JoinEvidence evidence{SubmapJoinConfig{}};
};

}  // namespace sparsight
