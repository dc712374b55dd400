#include "drivers/recording/pose_messages.h"

#include "drivers/recording/ros_header.h"

namespace sparsight {
namespace {

// Point or Vector3, then Quaternion: Pose and Transform look the same on the wire.
void write_isometry(const Eigen::Isometry3d& T, CdrWriter& writer) {
  for (int i = 0; i < 3; ++i) writer.number(T.translation()[i]);
  const Eigen::Quaterniond rotation(T.linear());
  for (int i = 0; i < 4; ++i) writer.number(rotation.coeffs()[i]);  // x, y, z, w
}

}  // namespace

void append_pose(const StampedPose& pose, std::vector<std::uint8_t>& out) {
  CdrWriter writer(out);
  write_header({pose.time, pose.frame}, writer);
  write_isometry(pose.T_frame_camera, writer);
}

void append_transform(const NamedTransform& transform, std::vector<std::uint8_t>& out) {
  CdrWriter writer(out);
  writer.length(1);
  write_header({transform.time, transform.parent}, writer);
  writer.text(transform.child);
  write_isometry(transform.T_parent_child, writer);
}

}  // namespace sparsight
