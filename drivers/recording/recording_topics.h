#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sparsight {

// The topics of a recording.
enum class RecordingTopic : std::uint8_t {
  kFrameInfo,
  kImage,
  kCompressedImage,  // instead of kImage where the camera gives JPEG
  kCameraInfo,
  kPackets,
  kPositions,
  kEdges,
  kDeviceStates,
  kSyncStates,
  kPoses,     // in the odometry's frame
  kMapPoses,  // in the map's
  kTransforms,
  kStaticTransforms,
};

struct TopicDescription {
  RecordingTopic topic;
  std::string_view name;
  std::string_view type;
  bool latched = false;  // late subscribers are given it too: ROS's "transient local"
};

inline constexpr std::size_t kRecordingTopics = 13;
const TopicDescription& description_of(RecordingTopic topic);
// The topic of this name, if it has the type it has with us.
std::optional<RecordingTopic> recording_topic(std::string_view name, std::string_view type);

// As rosbag2 stores the quality of service it offers on replay (YAML); the profile "ros2" asks for
// it in every channel's metadata.
std::string offered_qos_profiles(const TopicDescription& topic);

}  // namespace sparsight
