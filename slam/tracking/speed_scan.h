#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <optional>

#include "slam/tracking/photometric_alignment.h"

namespace sparsight {

// A frame that moves the near points by tens of pixels has a photometric minimum every few pixels
// along its way, wherever posts, stripes or a car that drives along line up again, while rotation,
// which far points tell, is found in any of them. Looks for a lower cost up to a fifth of the way
// before and behind the minimum found; nothing if that is the lowest, or if the frame is slow.
//
// `way`: the camera's expected translation since the last frame, in the keyframe's frame, metres.
std::optional<Alignment> best_speed(
    const PatchSet& patches, const GreyImage& image, const CameraModel& camera,
    double mean_inverse_depth, const Alignment& found, const Eigen::Vector3d& way,
    const std::function<bool(const Eigen::Isometry3d& T_keyframe_camera)>& plausible,
    const PhotometryConfig& photometry, AlignmentWorkspace& workspace);

}  // namespace sparsight
