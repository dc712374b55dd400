#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "drivers/recording/camera_messages.h"
#include "drivers/recording/lidar_messages.h"
#include "drivers/recording/message_schemas.h"
#include "drivers/recording/pose_messages.h"
#include "drivers/recording/recording_topics.h"
#include "drivers/recording/state_messages.h"

namespace sparsight {
namespace {

using ::testing::HasSubstr;
using Buffer = std::vector<std::uint8_t>;

HostTime host_time_ns(std::int64_t ns) { return HostTime(std::chrono::nanoseconds(ns)); }

TEST(VelodyneScan, OfOnePacketIsTheseBytes) {
  LidarPacket packet{host_time_ns(0x0102'0304LL * 1'000'000'000 + 0x0506'0708)};
  packet.payload[0] = 0xff;
  packet.payload[1205] = 0x37;
  Buffer bytes;
  append_scan(packet, bytes);
  // 4 encapsulation, 8 stamp, 4 + 9 frame name, 3 padding, 4 count, 8 stamp, 1206 payload.
  ASSERT_EQ(bytes.size(), 1246);
  const Buffer head(bytes.begin(), bytes.begin() + 41);
  EXPECT_EQ(head, (Buffer{0, 1, 0,   0,   0x04, 0x03, 0x02, 0x01, 0x08, 0x07, 0x06, 0x05, 9,   0,
                          0, 0, 'v', 'e', 'l',  'o',  'd',  'y',  'n',  'e',  0,    0,    0,   0,
                          1, 0, 0,   0,   0x04, 0x03, 0x02, 0x01, 0x08, 0x07, 0x06, 0x05, 0xff}));
  EXPECT_EQ(bytes.back(), 0x37);
}

TEST(VelodyneScan, OfARevolutionIsReadPacketByPacket) {
  Buffer bytes;
  append_scan(LidarPacket{host_time_ns(5)}, bytes);
  bytes[28] = 3;  // packets
  for (std::uint8_t i = 1; i < 3; ++i) {
    bytes.resize(bytes.size() + 2);  // the stamp of the next is aligned
    bytes.insert(bytes.end(), {1, 0, 0, 0, i, 0, 0, 0});
    bytes.resize(bytes.size() + 1206, i);
  }
  std::vector<LidarPacket> packets;
  ASSERT_TRUE(read_scan(bytes, packets));
  ASSERT_EQ(packets.size(), 3);
  EXPECT_EQ(packets[2].arrival, host_time_ns(1'000'000'002));
  EXPECT_EQ(packets[2].payload[1205], 2);
  bytes.pop_back();
  EXPECT_FALSE(read_scan(bytes, packets));
  EXPECT_EQ(packets.size(), 2);  // those that are whole
}

TEST(SyncStateMessage, KeepsEveryValue) {
  RecordedSyncState state;
  state.frame_sequence = 1;
  state.frame_epoch = 2;
  state.exposure_middle = host_time_ns(-3);
  state.exposure_uncertainty = std::chrono::nanoseconds(4);
  state.exposure_quality = StampQuality::kMeasured;
  for (const bool with_clock : {false, true}) {
    if (with_clock) {
      state.lidar_clock =
          RecordedLidarClock{std::chrono::nanoseconds(-5), 6.5, std::chrono::nanoseconds(7), 8,
                             StampQuality::kEstimated};
    }
    Buffer bytes;
    append_sync_state(state, bytes);
    RecordedSyncState read;
    ASSERT_TRUE(read_sync_state(bytes, read));
    EXPECT_EQ(read, state);
    EXPECT_FALSE(read_sync_state(Bytes(bytes).first(bytes.size() - 1), read));
  }
}

TEST(StateMessages, RefuseChoicesThatDoNotExist) {
  Buffer bytes;
  append_edge(Edge{}, bytes);
  Edge edge;
  EXPECT_TRUE(read_edge(bytes, edge));
  bytes[4] = 2;
  EXPECT_FALSE(read_edge(bytes, edge));

  Buffer states;
  append_device_state({DeviceKind::kTrigger, DeviceState::kEnded, {}}, states);
  DeviceStateChange change{};
  EXPECT_TRUE(read_device_state(states, change));
  states[5] = 5;
  EXPECT_FALSE(read_device_state(states, change));
  states[5] = 4;
  states[4] = 3;
  EXPECT_FALSE(read_device_state(states, change));

  Buffer info;
  CameraFrame frame;
  append_frame_info(frame, info);
  EXPECT_TRUE(read_frame_info(info, frame));
  info[4 + 33] = 13;
  EXPECT_FALSE(read_frame_info(info, frame));
}

TEST(ForeignImage, IsRefusedWhereItCannotBeAFrame) {
  CameraFrame frame{.width = 2, .height = 2, .stride_bytes = 2};
  frame.bytes = {1, 2, 3};
  Buffer bytes;
  append_image(frame, bytes);
  CameraFrame read;
  ASSERT_TRUE(read_foreign_image(bytes, read));
  EXPECT_TRUE(read.damaged);  // a byte is missing
  std::string text(bytes.begin(), bytes.end());
  text.replace(text.find("mono8"), 5, "rgb99");
  EXPECT_FALSE(read_foreign_image(as_bytes(text), read));
}

TEST(MessageSchemas, CarryTheTypesTheyContain) {
  const std::string separator(80, '=');
  const std::string image = schema_text(message_type::kImage);
  EXPECT_THAT(image, HasSubstr("\n" + separator + "\nMSG: std_msgs/Header\nbuiltin"));
  EXPECT_THAT(image, HasSubstr("\n" + separator + "\nMSG: builtin_interfaces/Time\nint32 sec\n"));
  for (std::size_t i = 0; i < kRecordingTopics; ++i) {
    const TopicDescription& topic = description_of(static_cast<RecordingTopic>(i));
    EXPECT_EQ(static_cast<std::size_t>(topic.topic), i);
    EXPECT_FALSE(schema_text(topic.type).empty()) << topic.type;
    EXPECT_EQ(recording_topic(topic.name, topic.type), topic.topic);
    EXPECT_FALSE(recording_topic(topic.name, "other").has_value());
  }
  EXPECT_EQ(schema_text("no_msgs/msg/Such"), "");
}

}  // namespace
}  // namespace sparsight
