#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <span>
#include <vector>

#include "slam/geometry/camera_model.h"
#include "slam/points/camera_returns.h"

namespace sparsight {

// A cloud of a keyframe nearby, and where that keyframe stood in the camera frame of the view.
struct NearbyCloud {
  Eigen::Isometry3d T_view_nearby = Eigen::Isometry3d::Identity();
  std::span<const Eigen::Vector3f> cloud;  // in that keyframe's camera frame, metres
};

// Sec. III and IV-E: the depth of adjacent keyframes integrated into one view, since a single
// sparse scan reaches a part of the image only. Of the returns that fall into the same few pixels
// the nearest is kept, and those that a nearer one close by hides are left out.
std::vector<CameraReturn> integrated_depth(std::span<const NearbyCloud> clouds,
                                           const CameraModel& camera);

// Depth at any pixel of the view, where returns near it agree.
class DepthLookup {
 public:
  DepthLookup(const std::vector<CameraReturn>& returns, const CameraModel& camera);

  // The point on the pixel's ray; nothing where no return is near or where they disagree.
  std::optional<Eigen::Vector3d> at(const Eigen::Vector2f& pixel) const;

 private:
  const std::vector<CameraReturn>& returns_;
  CameraModel camera_;
  int columns_;
  int rows_;
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace sparsight
