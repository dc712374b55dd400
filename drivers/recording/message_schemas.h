#pragma once

#include <string>
#include <string_view>

namespace sparsight {

// Message types as ROS 2 names them in full: "sensor_msgs/msg/Image".
namespace message_type {
inline constexpr std::string_view kImage = "sensor_msgs/msg/Image";
inline constexpr std::string_view kCompressedImage = "sensor_msgs/msg/CompressedImage";
inline constexpr std::string_view kCameraInfo = "sensor_msgs/msg/CameraInfo";
inline constexpr std::string_view kVelodyneScan = "velodyne_msgs/msg/VelodyneScan";
inline constexpr std::string_view kPoseStamped = "geometry_msgs/msg/PoseStamped";
inline constexpr std::string_view kTransforms = "tf2_msgs/msg/TFMessage";
inline constexpr std::string_view kCameraFrameInfo = "sparsight_msgs/msg/CameraFrameInfo";
inline constexpr std::string_view kEdge = "sparsight_msgs/msg/Edge";
inline constexpr std::string_view kPositionPacket = "sparsight_msgs/msg/PositionPacket";
inline constexpr std::string_view kDeviceState = "sparsight_msgs/msg/DeviceState";
inline constexpr std::string_view kSyncState = "sparsight_msgs/msg/SyncState";
}  // namespace message_type

// The definition with those of all types it contains, as the schema encoding "ros2msg" wants it
// (mcap.dev/spec/registry); empty for a type that is not one of the above.
std::string schema_text(std::string_view type);

}  // namespace sparsight
