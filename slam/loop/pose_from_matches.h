#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

namespace sparsight {

struct PoseFromMatches {
  Eigen::Isometry3d T_camera_points = Eigen::Isometry3d::Identity();
  int inliers = 0;
};

// The camera that sees points (of any frame) at places on its plane z = 1, whatever share of the
// pairs is wrong; nothing if no pose explains min_inliers within `tolerance` (on that plane).
// OpenCV's solvePnPRansac, which draws the same samples every time.
std::optional<PoseFromMatches> pose_from_matches(const std::vector<Eigen::Vector3d>& points,
                                                 const std::vector<Eigen::Vector2d>& normalized,
                                                 double tolerance, int min_inliers);

}  // namespace sparsight
