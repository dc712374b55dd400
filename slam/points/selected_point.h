#pragma once

#include <Eigen/Core>

namespace sparsight {

// A LiDAR return chosen for tracking, in the keyframe's camera frame at its exposure.
struct SelectedPoint {
  Eigen::Vector3f p_camera;  // metres
  Eigen::Vector2f pixel;     // its projection at the finest level
  // The surface around it: inverse depth is d + slope . (pixel offset), 1/(m px); a plane is
  // exactly affine in inverse depth. Zero where the neighbourhood does not tell.
  Eigen::Vector2f inverse_depth_slope = Eigen::Vector2f::Zero();
  float weight = 1.0F;  // of its patch's residuals
  bool rough = false;  // on no plane; then that is its weight in the window, in tracking it is more
};

}  // namespace sparsight
