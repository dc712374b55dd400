#pragma once

#include <rapidcheck.h>

#include "slam/geometry/se3.h"

namespace sparsight {

// Values for property tests, in steps of a 1/10000 so that failures shrink to readable numbers.
inline double any_between(double low, double high) {
  return low + (high - low) * 1e-4 * *rc::gen::inRange(0, 10001);
}

inline Eigen::Vector3d any_vector(double reach) {
  return {any_between(-reach, reach), any_between(-reach, reach), any_between(-reach, reach)};
}

inline Eigen::Vector3d any_direction() {
  const Eigen::Vector3d v = any_vector(1.0);
  return v.norm() > 0.1 ? v.normalized() : Eigen::Vector3d::UnitX();
}

// A turn of at most max_angle_rad and a shift of at most max_shift_m along each axis.
inline Vector6d any_increment(double max_angle_rad, double max_shift_m) {
  Vector6d xi;
  xi << any_between(0.0, max_angle_rad) * any_direction(), any_vector(max_shift_m);
  return xi;
}

inline Eigen::Isometry3d any_pose() { return exp_se3(any_increment(3.0, 10.0)); }

}  // namespace sparsight
