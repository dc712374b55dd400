#pragma once

#include <Eigen/Geometry>
#include <string_view>
#include <vector>

#include "hal/time.h"

namespace sparsight {

// A pose found while recording. For those who look at a recording: a replay does not read it.
struct RecordedPose {
  HostTime time;  // of the exposure
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
};

// geometry_msgs/PoseStamped.
void append_pose(const RecordedPose& pose, std::vector<std::uint8_t>& out);

// tf2_msgs/TFMessage with one transform.
struct NamedTransform {
  HostTime time;
  std::string_view parent;
  std::string_view child;
  Eigen::Isometry3d T_parent_child = Eigen::Isometry3d::Identity();
};
void append_transform(const NamedTransform& transform, std::vector<std::uint8_t>& out);

}  // namespace sparsight
