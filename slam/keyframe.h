#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "hal/time.h"
#include "slam/image/pyramid.h"
#include "slam/points/selected_point.h"
#include "slam/tracking/patch_set.h"

namespace sparsight {

// A return the camera saw, with its colour (grey cameras: r = g = b). For the map.
struct CloudPoint {
  Eigen::Vector3f p_camera;  // keyframe's camera frame at its exposure, metres
  float intensity = 0.0F;    // as the LiDAR gave it
  std::array<std::uint8_t, 3> rgb{};
};

// A frame in the window (Sec. IV-B2): its image, its depth, its pose.
struct Keyframe {
  std::uint64_t sequence = 0;
  HostTime exposure;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  bool predicted = false;  // tracking had failed: where it stands was not measured
  // Where the marginalisation prior was linearised; set once, when the prior first touches it.
  std::optional<Eigen::Isometry3d> T_world_camera_first;

  ImagePyramid pyramid;
  std::vector<SelectedPoint> points;
  std::vector<PatchSet> patches;    // per pyramid level
  double mean_inverse_depth = 0.0;  // 1/m, of the points
  std::vector<CloudPoint> cloud_camera;
};

}  // namespace sparsight
