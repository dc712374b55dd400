#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>

namespace sparsight {

// Where to look for a frame when the predicted motion did not lead to it (or there is none yet):
// the prediction, standing still since the last frame, half and twice the motion, and turns and
// shifts around it, in the spirit of DSO's coarse tracker (Engel et al. 2018, Sec. 3.1). Shifts
// scale with the scene: shares of its mean depth. Poses T_keyframe_camera, the likeliest first.
inline constexpr std::size_t kStartingMotions = 34;
std::array<Eigen::Isometry3d, kStartingMotions> starting_motions(
    const Eigen::Isometry3d& T_keyframe_previous, const Eigen::Isometry3d& T_keyframe_predicted,
    double mean_depth_m);

}  // namespace sparsight
