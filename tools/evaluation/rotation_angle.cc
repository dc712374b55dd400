#include "tools/evaluation/rotation_angle.h"

#include <cmath>

namespace sparsight {

double rotation_angle_rad(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d twice_sine(R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1));
  return std::atan2(twice_sine.norm(), R.trace() - 1.0);
}

}  // namespace sparsight
