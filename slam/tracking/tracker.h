#pragma once

#include <Eigen/Geometry>
#include <cstdint>

namespace sparsight {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

struct TrackerConfig {
  int pyramid_levels = 4;
  int max_iterations = 30;     // per level
  double student_t_dof = 5.0;  // nu of eq. (5)
};

struct TrackingResult {
  enum class Status : std::uint8_t { kConverged, kIterationLimit, kTooFewPoints, kDiverged };
  Status status = Status::kTooFewPoints;
  Eigen::Isometry3d T_keyframe_camera = Eigen::Isometry3d::Identity();
  Matrix6d information = Matrix6d::Zero();  // left perturbation, [rotation, translation], eq. (2)
  int points_used = 0;
  double residual_sigma_grey = 0.0;
};

}  // namespace sparsight
