#include "drivers/recording/recording_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>

#include "drivers/recording/camera_messages.h"
#include "tests/drivers/datasets/small_dataset.h"
#include "tests/drivers/recording/made_events.h"
#include "tests/drivers/recording/made_recording.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using testing::agreeing;
using testing::all_events;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::host_ns;
using testing::made_content;
using testing::made_events;
using testing::open_bytes;
using ::testing::Pair;
using testing::recorded;
using testing::same;

McapWriterOptions packed_with(Compression compression) {
  McapWriterOptions options;
  options.compression = compression;
  return options;
}

class RecordingOfEachCompression : public ::testing::TestWithParam<Compression> {};

TEST_P(RecordingOfEachCompression, GivesBackEveryEventBitForBit) {
  const auto events = made_events(2500ms);
  auto source = open_bytes(recorded(events, packed_with(GetParam())));
  ASSERT_TRUE(source) << source.error().message;
  const auto read = all_events(**source);
  EXPECT_EQ(read.size(), events.size());
  EXPECT_EQ(agreeing(read, events), events.size());
  EXPECT_EQ((*source)->faults().refused_messages, 0);
  EXPECT_EQ((*source)->faults().file.damaged_chunks, 0);
}

TEST_P(RecordingOfEachCompression, IsTheSameBytesEachTime) {
  const auto events = made_events(700ms);
  EXPECT_EQ(recorded(events, packed_with(GetParam())), recorded(events, packed_with(GetParam())));
}

INSTANTIATE_TEST_SUITE_P(, RecordingOfEachCompression,
                         ::testing::Values(Compression::kNone, Compression::kLz4,
                                           Compression::kZstd),
                         testing::compression_name);

TEST(RecordingSource, SaysWhatTheRecordingHolds) {
  auto source = open_bytes(recorded(made_events(1000ms)));
  const RecordingInfo& info = (*source)->info();
  EXPECT_TRUE(info.indexed);
  EXPECT_FALSE(info.truncated);
  EXPECT_EQ(info.first, host_ns(1'000'000'000'000));
  EXPECT_NEAR(to_seconds(info.duration()), 1.0, 0.02);
  EXPECT_EQ(info.messages.at("/camera/image"), 31);
  EXPECT_EQ(info.messages.at("/camera/frame_info"), 31);
  EXPECT_EQ(info.messages.at("/camera/camera_info"), 31);
  EXPECT_EQ(info.messages.at("/velodyne_packets"), 754);
  EXPECT_EQ(info.messages.at("/sync/edges"), 63);
  EXPECT_EQ(info.messages.at("/tf_static"), 1);
  EXPECT_THAT(info.attachments, ElementsAre("rig.toml"));
  EXPECT_THAT(info.session, ::testing::Contains(Pair("serial", "7")));
  EXPECT_THAT(info.session, ::testing::Contains(Pair("clock", "CLOCK_MONOTONIC")));
  EXPECT_EQ(info.utc_offset, made_content().utc_offset);
  EXPECT_EQ(*(*source)->attachment("rig.toml"), "name = \"made\"\n");
  EXPECT_THAT((*source)->attachment("other").error().message, HasSubstr("no attachment 'other'"));
}

TEST(RecordingSource, KeepsJpegFramesAndEveryOtherFormat) {
  for (int format = 0; format <= static_cast<int>(PixelFormat::kMjpeg); ++format) {
    const auto events =
        made_events(100ms, {.width = 8, .height = 6, .format = static_cast<PixelFormat>(format)});
    auto source = open_bytes(recorded(events));
    EXPECT_EQ(agreeing(all_events(**source), events), events.size()) << "format " << format;
    EXPECT_EQ((*source)->info().messages.contains("/camera/image/compressed"),
              static_cast<PixelFormat>(format) == PixelFormat::kMjpeg);
  }
}

RC_GTEST_PROP(RecordingSource, KeepsEveryFieldOfAnyFrame, ()) {
  auto frame = std::make_shared<CameraFrame>();
  frame->sequence = *rc::gen::arbitrary<std::uint32_t>();
  frame->epoch = *rc::gen::arbitrary<std::uint32_t>();
  frame->driver_time = host_ns(*rc::gen::arbitrary<std::int64_t>());
  frame->arrival = host_ns(*rc::gen::arbitrary<std::int64_t>());
  frame->exposure = std::chrono::nanoseconds(*rc::gen::arbitrary<std::int64_t>());
  frame->damaged = *rc::gen::arbitrary<bool>();
  frame->format = static_cast<PixelFormat>(*rc::gen::inRange(0, 12));
  frame->width = *rc::gen::arbitrary<int>();
  frame->height = *rc::gen::arbitrary<int>();
  frame->stride_bytes = *rc::gen::arbitrary<int>();
  frame->bytes = *rc::gen::arbitrary<std::vector<std::uint8_t>>();
  const RigEvent event = std::shared_ptr<const CameraFrame>(frame);
  auto source = open_bytes(recorded({event}));
  const std::optional<RigEvent> read = (*source)->next();
  RC_ASSERT(read.has_value());
  RC_ASSERT(same(*read, event));
  RC_ASSERT(!(*source)->next().has_value());
}

RC_GTEST_PROP(RecordingSource, KeepsEveryFieldOfAnyOtherEvent, ()) {
  const auto seconds = *rc::gen::inRange<std::int64_t>(0, 2'000'000'000);
  const HostTime time = host_ns(seconds * 1'000'000'000 + *rc::gen::inRange(0, 1'000'000'000));
  LidarPacket packet{time};
  for (auto& byte : packet.payload) byte = static_cast<std::uint8_t>(*rc::gen::inRange(0, 256));
  PositionPacket position{time};
  position.payload.fill(packet.payload[5]);
  const std::vector<RigEvent> events = {
      packet, position,
      Edge{static_cast<EdgeLine>(*rc::gen::inRange(0, 2)), *rc::gen::arbitrary<bool>(), time},
      DeviceStateChange{static_cast<DeviceKind>(*rc::gen::inRange(0, 3)),
                        static_cast<DeviceState>(*rc::gen::inRange(0, 5)), time}};
  auto source = open_bytes(recorded(events));
  RC_ASSERT(agreeing(all_events(**source), events) == events.size());
}

TEST(RecordingSource, PutsEventsOfSeveralThreadsInTheOrderOfTheirArrival) {
  const auto events = made_events(1500ms);
  auto handed_over = events;
  std::mt19937 random(4);
  for (std::size_t i = 0; i + 20 < handed_over.size(); i += 20) {
    std::shuffle(handed_over.begin() + static_cast<long>(i),
                 handed_over.begin() + static_cast<long>(i) + 20, random);
  }
  auto source = open_bytes(recorded(handed_over));
  const auto read = all_events(**source);
  ASSERT_EQ(read.size(), events.size());
  EXPECT_TRUE(std::ranges::is_sorted(read, {}, arrival_of));
}

TEST(RecordingSource, GivesEventsOfOneInstantAsRecorded) {
  std::vector<RigEvent> events;
  for (std::uint8_t i = 0; i < 50; ++i) {
    LidarPacket packet{host_ns(5)};
    packet.payload[0] = i;
    events.emplace_back(packet);
    events.emplace_back(Edge{EdgeLine::kExposure, i % 2 == 0, host_ns(5)});
  }
  auto source = open_bytes(recorded(events));
  EXPECT_EQ(agreeing(all_events(**source), events), events.size());
}

TEST(RecordingSource, PassesOverPosesAndSyncStates) {
  testing::MadeDisk disk;
  auto writer = *RecordingWriter::start(std::make_unique<testing::MadeOutput>(disk), "made.mcap",
                                        made_content());
  const auto events = made_events(200ms);
  for (const RigEvent& event : events) {
    ASSERT_TRUE(writer->write(event));
    ASSERT_TRUE(writer->write(RecordedPose{arrival_of(event)}));
    ASSERT_TRUE(writer->write(RecordedSyncState{.exposure_middle = arrival_of(event)}));
  }
  ASSERT_TRUE(writer->close());
  auto source = open_bytes(disk.bytes);
  EXPECT_EQ(agreeing(all_events(**source), events), events.size());
  EXPECT_EQ((*source)->info().messages.at("/tf"), events.size());
  EXPECT_EQ((*source)->info().messages.at("/sync/state"), events.size());
}

TEST(RecordingSource, ReadsImagesOfOtherTools) {
  testing::MadeDisk disk;
  McapWriter writer(std::make_unique<testing::MadeOutput>(disk), {});
  writer.start();
  const auto schema = writer.add_schema("sensor_msgs/msg/Image", "ros2msg", "any");
  const auto channel = writer.add_channel(schema, "/camera/image", "cdr", {});
  const auto other = writer.add_channel(schema, "/camera/image", "json", {});
  CameraFrame frame{.driver_time = host_ns(40), .width = 3, .height = 2, .stride_bytes = 3};
  frame.bytes = {1, 2, 3, 4, 5, 6};
  for (const auto id : {channel, other}) {
    append_image(frame, writer.begin_message({id, 9, 50, 40}));
    writer.end_message();
  }
  ASSERT_FALSE(writer.close());
  auto source = open_bytes(disk.bytes);
  const auto read = all_events(**source);
  ASSERT_EQ(read.size(), 1);
  frame.sequence = 9;
  frame.arrival = host_ns(50);
  EXPECT_TRUE(same(*std::get<0>(read[0]), frame));
}

TEST(RecordingSource, RefusesWhatIsNoRecording) {
  const testing::TemporaryFolder folder;
  EXPECT_EQ(RecordingSource::open(folder.path() / "none.mcap").error().code, ErrorCode::kNotFound);
  EXPECT_EQ(RecordingSource::open(folder.path()).error().code, ErrorCode::kUnreadable);
  testing::write_file(folder.path() / "text.mcap", "not a recording at all");
  const auto error = RecordingSource::open(folder.path() / "text.mcap").error();
  EXPECT_EQ(error.code, ErrorCode::kMalformed);
  EXPECT_THAT(error.message, HasSubstr("text.mcap: does not start as an MCAP file"));
  EXPECT_FALSE(open_bytes({}));
}

TEST(RecordingWriter, NeverOverwritesARecording) {
  const testing::TemporaryFolder folder;
  testing::write_file(folder.path() / "r.mcap", "precious");
  const auto writer = RecordingWriter::create(folder.path() / "r.mcap", {});
  ASSERT_FALSE(writer);
  EXPECT_THAT(writer.error().message, HasSubstr("choose another name"));
  EXPECT_EQ(testing::read_file(folder.path() / "r.mcap"), "precious");
  EXPECT_FALSE(RecordingWriter::create(folder.path() / "no" / "r.mcap", {}));
  EXPECT_TRUE(RecordingWriter::create(folder.path() / "r.mcap", {}, {}, ExistingFile::kReplace));
}

}  // namespace
}  // namespace sparsight
