#include "drivers/recording/recording_topics.h"

#include <fmt/format.h>

#include <algorithm>

#include "drivers/recording/message_schemas.h"

namespace sparsight {
namespace {

// In the order of the enumeration.
constexpr std::array<TopicDescription, kRecordingTopics> kTopics{{
    {RecordingTopic::kFrameInfo, "/camera/frame_info", message_type::kCameraFrameInfo},
    {RecordingTopic::kImage, "/camera/image", message_type::kImage},
    {RecordingTopic::kCompressedImage, "/camera/image/compressed", message_type::kCompressedImage},
    {RecordingTopic::kCameraInfo, "/camera/camera_info", message_type::kCameraInfo},
    {RecordingTopic::kPackets, "/velodyne_packets", message_type::kVelodyneScan},
    {RecordingTopic::kPositions, "/velodyne_position", message_type::kPositionPacket},
    {RecordingTopic::kEdges, "/sync/edges", message_type::kEdge},
    {RecordingTopic::kDeviceStates, "/devices", message_type::kDeviceState, true},
    {RecordingTopic::kSyncStates, "/sync/state", message_type::kSyncState},
    {RecordingTopic::kPoses, "/pose", message_type::kPoseStamped},
    {RecordingTopic::kMapPoses, "/map_pose", message_type::kPoseStamped},
    {RecordingTopic::kTransforms, "/tf", message_type::kTransforms},
    {RecordingTopic::kStaticTransforms, "/tf_static", message_type::kTransforms, true},
}};

}  // namespace

const TopicDescription& description_of(RecordingTopic topic) {
  return kTopics[static_cast<std::size_t>(topic)];
}

std::optional<RecordingTopic> recording_topic(std::string_view name, std::string_view type) {
  const auto found = std::ranges::find_if(kTopics, [&](const TopicDescription& topic) {
    return topic.name == name && topic.type == type;
  });
  if (found == kTopics.end()) return std::nullopt;
  return found->topic;
}

std::string offered_qos_profiles(const TopicDescription& topic) {
  // rmw/types.h: history 1 keep last, reliability 1 reliable, durability 1 transient local and
  // 2 volatile, liveliness 1 automatic; the longest duration stands for none.
  constexpr std::string_view kNever = "    sec: 2147483647\n    nsec: 4294967295\n";
  return fmt::format(
      "- history: 1\n  depth: {}\n  reliability: 1\n  durability: {}\n  deadline:\n{}"
      "  lifespan:\n{}  liveliness: 1\n  liveliness_lease_duration:\n{}"
      "  avoid_ros_namespace_conventions: false\n",
      topic.latched ? 1 : 10, topic.latched ? 1 : 2, kNever, kNever, kNever);
}

}  // namespace sparsight
