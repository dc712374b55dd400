#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "slam/image/pyramid.h"
#include "slam/points/selected_point.h"
#include "slam/tracking/tracking_target.h"

namespace sparsight {

// A return within the image, with its colour (grey cameras: r = g = b). For the map.
struct CloudPoint {
  Eigen::Vector3f p_camera;  // keyframe's camera frame at its exposure, metres
  float intensity = 0.0F;    // as the LiDAR gave it
  std::array<std::uint8_t, 3> rgb{};
  // False: something nearer hides it from the camera, which stands elsewhere than the LiDAR; the
  // pixel there shows that, and rgb is black.
  bool colored = true;
};

// A frame in the window (Sec. IV-B2): its image, its depth, its pose.
struct Keyframe : TrackingTarget {
  bool begins_submap = false;  // tracking was lost: where it stands is a guess
  // Where the marginalisation prior was linearised; set once, when the prior first touches it.
  std::optional<Eigen::Isometry3d> T_world_camera_first;

  ImagePyramid pyramid;
  std::vector<SelectedPoint> points;
  std::vector<CloudPoint> cloud_camera;
};

}  // namespace sparsight
