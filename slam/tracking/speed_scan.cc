#include "slam/tracking/speed_scan.h"

#include <algorithm>
#include <cmath>

namespace sparsight {
namespace {

constexpr double kFastPx = 40.0;
constexpr double kRange = 0.2;   // of the way; farther off, what moves along fits better
constexpr double kStepPx = 4.0;  // of points at mean depth; a minimum at the finest level is wider
constexpr int kMostSteps = 20;   // to each side
constexpr double kLeastInSight = 0.1;

}  // namespace

std::optional<Alignment> best_speed(
    const PatchSet& patches, const GreyImage& image, const CameraModel& camera,
    double mean_inverse_depth, const Alignment& found, const Eigen::Vector3d& way,
    const std::function<bool(const Eigen::Isometry3d& T_keyframe_camera)>& plausible,
    const PhotometryConfig& photometry, AlignmentWorkspace& workspace) {
  const double way_px = camera.intrinsics().fx * way.norm() * mean_inverse_depth;
  if (way_px < kFastPx) return std::nullopt;
  const int steps = std::min(kMostSteps, static_cast<int>(std::ceil(kRange * way_px / kStepPx)));
  const Eigen::Isometry3d T_keyframe_found = found.T_camera_keyframe.inverse();
  std::optional<Alignment> best;
  double best_cost = found.cost;
  for (int step = -steps; step <= steps; ++step) {
    Eigen::Isometry3d T_keyframe_camera = T_keyframe_found;
    T_keyframe_camera.translation() += kRange * step / steps * way;
    if (step == 0 || !plausible(T_keyframe_camera)) continue;
    Alignment at = found;
    at.T_camera_keyframe = T_keyframe_camera.inverse();
    at = assess(patches, image, camera, at, photometry, workspace);
    if (at.visible_share < kLeastInSight || !(at.cost < best_cost)) continue;
    best_cost = at.cost;
    best = at;
  }
  return best;
}

}  // namespace sparsight
