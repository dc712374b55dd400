#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "hal/time.h"
#include "slam/geometry/se3.h"
#include "slam/keyframe.h"

namespace sparsight {

// A keyframe that has left the window: its pose is final for the odometry.
struct RetiredKeyframe {
  std::uint64_t sequence = 0;
  HostTime exposure;
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  // What the window knew, when this keyframe left, about the next one relative to it.
  struct Successor {
    std::uint64_t sequence = 0;
    Eigen::Isometry3d T_keyframe_successor = Eigen::Isometry3d::Identity();
    Matrix6d information = Matrix6d::Zero();  // left perturbation of T_keyframe_successor
  };
  std::optional<Successor> successor;  // none for the last keyframe
  std::vector<CloudPoint> cloud_camera;
  ImagePyramid pyramid;
  bool begins_submap = false;  // where it stands relative to those before is a guess
};

}  // namespace sparsight
