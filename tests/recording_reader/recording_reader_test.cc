#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "drivers/recording/crc32.h"
#include "drivers/recording/recorder.h"
#include "drivers/recording/recover.h"
#include "tests/build_paths.h"
#include "tests/drivers/datasets/small_dataset.h"
#include "tests/drivers/recording/made_events.h"
#include "tests/drivers/recording/made_recording.h"

// What we write, read by @mcap/core and @foxglove/rosmsg2-serialization: every message is decoded
// and every checksum checked there; here its findings are compared with what was recorded.
namespace sparsight {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::made_content;
using testing::made_events;
using testing::TemporaryFolder;

struct Reading {
  int exit_code = -1;
  std::string output;  // JSON, or the reader's complaint
};

Reading read_independently(const std::filesystem::path& file) {
  const auto reader = testing::build_dir() / "tests/recording_reader/npm/read_recording.mjs";
  const std::string command =
      fmt::format("'{}' '{}' '{}' 2>&1", SPARSIGHT_NODE, reader.string(), file.string());
  Reading reading;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return reading;
  char buffer[4096];
  while (const std::size_t count = fread(buffer, 1, sizeof(buffer), pipe)) {
    reading.output.append(buffer, count);
  }
  reading.exit_code = WEXITSTATUS(pclose(pipe));
  return reading;
}

void record(const std::filesystem::path& file, const std::vector<RigEvent>& events,
            Compression compression) {
  McapWriterOptions options;
  options.compression = compression;
  auto writer = RecordingWriter::create(file, made_content(), options);
  ASSERT_TRUE(writer) << writer.error().message;
  RecordedPose pose{testing::host_ns(1'000'000'000'005)};
  pose.T_world_camera.translation() << 1.5, -2.5, 3.5;
  pose.T_map_world = Eigen::Isometry3d(Eigen::Translation3d(10.0, 0.0, 0.0));
  for (const RigEvent& event : events) ASSERT_TRUE((*writer)->write(event));
  ASSERT_TRUE((*writer)->write(pose));
  ASSERT_TRUE((*writer)->write(RecordedSyncState{
      .frame_sequence = 7,
      .exposure_middle = testing::host_ns(123),
      .exposure_quality = StampQuality::kMeasured,
      .lidar_clock = RecordedLidarClock{.offset = -5ns, .drift_ppm = 12.5, .epoch = 2}}));
  ASSERT_TRUE((*writer)->close());
}

json payload(Bytes bytes) { return {{"length", bytes.size()}, {"crc", crc32_of(bytes)}}; }

const CameraFrame& first_frame(const std::vector<RigEvent>& events) {
  for (const RigEvent& event : events) {
    if (const auto* frame = std::get_if<0>(&event)) return **frame;
  }
  throw std::logic_error("no frame");
}

class IndependentReaderOfEachCompression : public ::testing::TestWithParam<Compression> {};

TEST_P(IndependentReaderOfEachCompression, DecodesEveryMessageAndFindsEveryChecksumRight) {
  const TemporaryFolder folder;
  const auto events = made_events(1500ms);
  record(folder.path() / "r.mcap", events, GetParam());
  const Reading reading = read_independently(folder.path() / "r.mcap");
  ASSERT_EQ(reading.exit_code, 0) << reading.output;
  const json found = json::parse(reading.output);
  EXPECT_EQ(found["header"]["profile"], "ros2");
  EXPECT_GE(found["index"]["chunks"], 3);
  EXPECT_EQ(found["attachments"]["rig.toml"], "name = \"made\"\n");
  EXPECT_EQ(found["metadata"]["sparsight"]["utc_minus_monotonic_ns"], "1790000000123456789");
  const json& topics = found["topics"];
  EXPECT_EQ(topics["/camera/image"]["count"], 46);
  EXPECT_EQ(topics["/velodyne_packets"]["count"], 1131);
  EXPECT_EQ(topics["/velodyne_position"]["count"], 2);
  EXPECT_EQ(topics["/sync/edges"]["count"], 2 * 46 + 2);
  EXPECT_EQ(topics["/devices"]["count"], 1);
}

TEST_P(IndependentReaderOfEachCompression, FindsARecoveredRecordingWhole) {
  const TemporaryFolder folder;
  record(folder.path() / "r.mcap", made_events(1500ms), GetParam());
  testing::truncate_file(folder.path() / "r.mcap", 0.7);
  EXPECT_NE(read_independently(folder.path() / "r.mcap").exit_code, 0);
  ASSERT_TRUE(recover_recording(folder.path() / "r.mcap", folder.path() / "whole.mcap"));
  const Reading reading = read_independently(folder.path() / "whole.mcap");
  ASSERT_EQ(reading.exit_code, 0) << reading.output;
  const json topics = json::parse(reading.output)["topics"];
  EXPECT_NEAR(topics["/velodyne_packets"]["count"].get<double>(), 0.7 * 1131, 100);
}

INSTANTIATE_TEST_SUITE_P(, IndependentReaderOfEachCompression,
                         ::testing::Values(Compression::kNone, Compression::kLz4,
                                           Compression::kZstd),
                         testing::compression_name);

TEST(IndependentReader, SeesTheCamerasBytes) {
  const TemporaryFolder folder;
  const auto events = made_events(100ms);
  record(folder.path() / "r.mcap", events, Compression::kLz4);
  const json topics = json::parse(read_independently(folder.path() / "r.mcap").output)["topics"];
  const CameraFrame& frame = first_frame(events);
  const json& image = topics["/camera/image"];
  EXPECT_EQ(image["type"], "sensor_msgs/msg/Image");
  EXPECT_EQ(image["first"]["width"], 40);
  EXPECT_EQ(image["first"]["height"], 30);
  EXPECT_EQ(image["first"]["step"], 40);
  EXPECT_EQ(image["first"]["encoding"], "mono8");
  EXPECT_EQ(image["first"]["data"], payload(frame.bytes));
  EXPECT_EQ(image["first"]["logTime"], "1000012345000");
  EXPECT_EQ(image["first"]["header"]["frame_id"], "camera");
  EXPECT_EQ(image["first"]["header"]["stamp"], json({{"sec", 1000}, {"nanosec", 5'000'000}}));
  const json& info = topics["/camera/frame_info"]["first"];
  EXPECT_EQ(info["sequence"], 0);
  EXPECT_EQ(info["epoch"], 3);
  EXPECT_EQ(info["driver_time"], "1000005000000");
  EXPECT_EQ(info["arrival"], "1000012345000");
  EXPECT_EQ(info["exposure"], "4000000");
  EXPECT_EQ(info["damaged"], false);
  const json& camera = topics["/camera/camera_info"]["first"];
  EXPECT_EQ(camera["distortion_model"], "plumb_bob");
  EXPECT_EQ(camera["d"], json({0.1, -0.05, 0.001, 0.002, 0.01}));
  EXPECT_EQ(camera["k"], json({35.0, 0, 19.5, 0, 36.0, 14.5, 0, 0, 1}));
}

TEST(IndependentReader, SeesJpegAsCompressedImages) {
  const TemporaryFolder folder;
  const auto events = made_events(100ms, {.format = PixelFormat::kMjpeg});
  record(folder.path() / "r.mcap", events, Compression::kNone);
  const json topics = json::parse(read_independently(folder.path() / "r.mcap").output)["topics"];
  const json& image = topics["/camera/image/compressed"];
  EXPECT_EQ(image["type"], "sensor_msgs/msg/CompressedImage");
  EXPECT_EQ(image["first"]["format"], "jpeg");
  EXPECT_EQ(image["first"]["data"], payload(first_frame(events).bytes));
}

TEST(IndependentReader, SeesScansOfOnePacket) {
  const TemporaryFolder folder;
  const auto events = made_events(100ms);
  record(folder.path() / "r.mcap", events, Compression::kZstd);
  const json topics = json::parse(read_independently(folder.path() / "r.mcap").output)["topics"];
  const json& scan = topics["/velodyne_packets"];
  EXPECT_EQ(scan["type"], "velodyne_msgs/msg/VelodyneScan");
  EXPECT_EQ(scan["bytes"], 1246);
  EXPECT_EQ(scan["first"]["header"]["frame_id"], "velodyne");
  EXPECT_EQ(scan["first"]["packets"].size(), 1);
  EXPECT_EQ(scan["first"]["packets"][0]["stamp"], json({{"sec", 1000}, {"nanosec", 7}}));
  EXPECT_EQ(scan["first"]["packets"][0]["data"]["length"], 1206);
  EXPECT_EQ(topics["/velodyne_position"]["first"]["payload"]["length"], 512);
}

TEST(IndependentReader, SeesStatesAndPoses) {
  const TemporaryFolder folder;
  record(folder.path() / "r.mcap", made_events(100ms), Compression::kNone);
  const json topics = json::parse(read_independently(folder.path() / "r.mcap").output)["topics"];
  const json& edge = topics["/sync/edges"]["first"];
  EXPECT_EQ(edge["line"], 0);
  EXPECT_EQ(edge["rising"], true);
  EXPECT_EQ(edge["time"], "1000000000000");
  EXPECT_EQ(topics["/devices"]["first"]["state"], 1);
  const json& sync = topics["/sync/state"]["first"];
  EXPECT_EQ(sync["frame_sequence"], 7);
  EXPECT_EQ(sync["exposure_middle"], "123");
  EXPECT_EQ(sync["exposure_quality"], 2);
  EXPECT_EQ(sync["lidar_clock_known"], true);
  EXPECT_EQ(sync["lidar_offset"], "-5");
  EXPECT_EQ(sync["lidar_drift_ppm"], 12.5);
  EXPECT_EQ(sync["lidar_epoch"], 2);
  EXPECT_EQ(topics["/pose"]["first"]["pose"]["position"],
            json({{"x", 1.5}, {"y", -2.5}, {"z", 3.5}}));
  const json& transform = topics["/tf"]["first"]["transforms"][0];
  EXPECT_EQ(transform["header"]["frame_id"], "odom");
  EXPECT_EQ(transform["child_frame_id"], "camera");
  EXPECT_EQ(transform["transform"]["translation"], json({{"x", 1.5}, {"y", -2.5}, {"z", 3.5}}));
  EXPECT_EQ(transform["transform"]["rotation"]["w"], 1.0);
  EXPECT_EQ(topics["/map_pose"]["first"]["header"]["frame_id"], "map");
  EXPECT_EQ(topics["/map_pose"]["first"]["pose"]["position"],
            json({{"x", 11.5}, {"y", -2.5}, {"z", 3.5}}));
  EXPECT_EQ(topics["/tf_static"]["first"]["transforms"][0]["child_frame_id"], "velodyne");
}

TEST(IndependentReader, NoticesDamage) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "r.mcap";
  record(file, made_events(600ms), Compression::kNone);
  std::string bytes = testing::read_file(file);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] + 1);
  testing::write_file(file, bytes);
  const Reading reading = read_independently(file);
  EXPECT_NE(reading.exit_code, 0);
  EXPECT_THAT(reading.output, HasSubstr("CRC"));
}

}  // namespace
}  // namespace sparsight
