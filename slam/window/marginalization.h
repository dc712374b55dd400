#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/geometry/se3.h"

namespace sparsight {

// A quadratic energy over the poses of the window, 1/2 d^T H d + b^T d, six rows per keyframe in
// the window's order. d stacks log(T_first^-1 T), the body increments since each pose's first
// estimate.
struct Quadratic {
  Eigen::MatrixXd H;
  Eigen::VectorXd b;

  explicit Quadratic(int keyframes = 0)
      : H(Eigen::MatrixXd::Zero(6 * keyframes, 6 * keyframes)),
        b(Eigen::VectorXd::Zero(6 * keyframes)) {}
};

// Minimises the energy over the first keyframe and drops its rows (Schur complement, Sec. IV-B3).
// Directions of that keyframe which nothing constrains are left out of it.
Quadratic without_first(const Quadratic& energy);

// What the energy tells about the second keyframe's body increment if the first is held and all
// others are left free.
Matrix6d information_of_second(const Quadratic& energy);

}  // namespace sparsight
