#include "slam/tracking/starting_motions.h"

#include <cmath>

#include "slam/geometry/se3.h"

namespace sparsight {

std::vector<Eigen::Isometry3d> starting_motions(const Eigen::Isometry3d& T_keyframe_previous,
                                                const Eigen::Isometry3d& T_keyframe_predicted,
                                                double mean_depth_m) {
  constexpr double kTurnsDeg[] = {3.0, 8.0};
  constexpr double kShifts[] = {0.05, 0.12, 0.25};

  const Vector6d motion = log_se3(T_keyframe_previous.inverse() * T_keyframe_predicted);
  std::vector<Eigen::Isometry3d> starts{T_keyframe_predicted, T_keyframe_previous,
                                        T_keyframe_previous * exp_se3(0.5 * motion),
                                        T_keyframe_previous * exp_se3(2.0 * motion)};
  const auto around = [&](int axis, double amount) {
    for (const double signed_amount : {amount, -amount}) {
      starts.push_back(T_keyframe_predicted * exp_se3(signed_amount * Vector6d::Unit(axis)));
    }
  };
  for (const double deg : kTurnsDeg) {
    for (const int axis : {1, 0, 2}) around(axis, deg * M_PI / 180.0);
  }
  for (const double share : kShifts) {
    for (const int axis : {5, 3, 4}) around(axis, share * mean_depth_m);
  }
  return starts;
}

}  // namespace sparsight
