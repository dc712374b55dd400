#include "slam/tracking/starting_motions.h"

#include <cmath>
#include <iterator>

#include "slam/geometry/se3.h"

namespace sparsight {

std::array<Eigen::Isometry3d, kStartingMotions> starting_motions(
    const Eigen::Isometry3d& T_keyframe_previous, const Eigen::Isometry3d& T_keyframe_predicted,
    double mean_depth_m) {
  constexpr double kTurnsDeg[] = {3.0, 8.0};
  constexpr double kShifts[] = {0.05, 0.12, 0.25};

  const Vector6d motion = log_se3(T_keyframe_previous.inverse() * T_keyframe_predicted);
  constexpr std::size_t kAlong = 4;
  std::array<Eigen::Isometry3d, kStartingMotions> starts{
      T_keyframe_predicted, T_keyframe_previous, T_keyframe_previous * exp_se3(0.5 * motion),
      T_keyframe_previous * exp_se3(2.0 * motion)};
  static_assert(kAlong + 2 * 3 * (std::size(kTurnsDeg) + std::size(kShifts)) == kStartingMotions);
  std::size_t count = kAlong;
  const auto around = [&](int axis, double amount) {
    for (const double signed_amount : {amount, -amount}) {
      starts[count++] = T_keyframe_predicted * exp_se3(signed_amount * Vector6d::Unit(axis));
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
