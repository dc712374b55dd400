#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string_view>
#include <vector>

#include "hal/time.h"

namespace sparsight {

// A pose found while recording. For those who look at a recording: a replay does not read it.
struct RecordedPose {
  HostTime time;                                                     // of the exposure
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();  // world: of the odometry
  std::optional<Eigen::Isometry3d> T_map_world;                      // while it is known; may jump
};

// geometry_msgs/PoseStamped: of the camera in a frame.
struct StampedPose {
  HostTime time;
  std::string_view frame;
  Eigen::Isometry3d T_frame_camera = Eigen::Isometry3d::Identity();
};
void append_pose(const StampedPose& pose, std::vector<std::uint8_t>& out);

// tf2_msgs/TFMessage with one transform.
struct NamedTransform {
  HostTime time;
  std::string_view parent;
  std::string_view child;
  Eigen::Isometry3d T_parent_child = Eigen::Isometry3d::Identity();
};
void append_transform(const NamedTransform& transform, std::vector<std::uint8_t>& out);

}  // namespace sparsight
