#include "drivers/datasets/capture_events.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/drivers/datasets/made_capture_folder.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::kCaptureSecond;
using testing::kPastHour;
using testing::MadeCapture;
using testing::MadeCaptureFolder;

constexpr CameraIntrinsics kSmallCamera{
    .width = 40, .height = 16, .fx = 30, .fy = 30, .cx = 19.5, .cy = 7.5};

Result<std::unique_ptr<CaptureEvents>> events_of(const MadeCaptureFolder& made,
                                                 const CaptureOptions& options = {}) {
  auto index = index_capture_folder(made.folder);
  EXPECT_TRUE(index) << index.error().message;
  return CaptureEvents::open(*index, {}, kSmallCamera, options);
}

std::string events_error(const MadeCaptureFolder& made) {
  const auto events = events_of(made);
  return events ? "opened" : events.error().message;
}

struct CapturedThings {
  std::vector<CameraFrame> frames;
  std::vector<LidarPacket> packets;
};
CapturedThings read_capture(CaptureEvents& events) {
  CapturedThings read;
  HostTime last{};
  while (const auto event = events.next()) {
    EXPECT_GE(arrival_of(*event), last);
    last = arrival_of(*event);
    if (const auto* packet = std::get_if<LidarPacket>(&*event)) read.packets.push_back(*packet);
    if (const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&*event)) {
      read.frames.push_back(**frame);
    }
  }
  EXPECT_FALSE(events.next());
  return read;
}

TEST(CaptureEvents, MixesFramesAndPacketsInTheirOrder) {
  const MadeCaptureFolder made;
  auto events = events_of(made);
  ASSERT_TRUE(events) << events.error().message;
  EXPECT_EQ((*events)->summary().packets, 377U);
  const CapturedThings read = read_capture(**events);
  EXPECT_EQ(read.packets.size(), 377U);
  ASSERT_EQ(read.frames.size(), 10U);
  EXPECT_NEAR(to_seconds(read.frames[0].driver_time.time_since_epoch() - kCaptureSecond * 1s), 0.05,
              1e-6);
  EXPECT_EQ(read.frames[0].arrival - read.frames[0].driver_time, 50ms) << "half a turn";
  EXPECT_EQ(read.frames[3].sequence, 3U);
  EXPECT_EQ(read.frames[3].bytes[0], 255);
  EXPECT_EQ(read.frames[3].bytes[1], 30);
}

TEST(CaptureEvents, KeepsColours) {
  const MadeCaptureFolder made;
  testing::write_image(made.image(2), testing::small_image(CV_8UC3, 2, 40, 16));
  auto events = events_of(made);
  const CapturedThings read = read_capture(**events);
  EXPECT_EQ(read.frames[1].format, PixelFormat::kGrey8);
  EXPECT_EQ(read.frames[2].format, PixelFormat::kRgb8);
  EXPECT_EQ(read.frames[2].stride_bytes, 120);
  ASSERT_EQ(read.frames[2].bytes.size(), 120U * 16U);
  EXPECT_EQ(read.frames[2].bytes[3], 30) << "red";
  EXPECT_EQ(read.frames[2].bytes[5], 20) << "blue";
}

TEST(CaptureEvents, AnImageThatCannotBeReadIsAFaultOfItsFrameByName) {
  const MadeCaptureFolder made;
  testing::truncate_file(made.image(0), 0.5);
  testing::write_image(made.image(4), testing::small_image(CV_8UC1, 4, 20, 16));
  auto events = events_of(made);
  ASSERT_TRUE(events) << events.error().message;
  const CapturedThings read = read_capture(**events);
  EXPECT_TRUE(read.frames[0].damaged);
  EXPECT_TRUE(read.frames[4].damaged);
  EXPECT_FALSE(read.frames[5].damaged);
  const auto& faults = (*events)->image_faults();
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_THAT(faults.at(0).message, HasSubstr("frame_1.png: not a readable PNG"));
  EXPECT_THAT(faults.at(4).message, HasSubstr("frame_5.png: 20 x 16 pixels"));
}

TEST(CaptureEvents, RefusesImagesOfAnotherSizeThanTheCalibration) {
  const MadeCaptureFolder made;
  for (int i = 0; i < 10; ++i) {
    testing::write_image(made.image(i), testing::small_image(CV_8UC1, i, 80, 24));
  }
  EXPECT_THAT(events_error(made),
              AllOf(HasSubstr("frame_1.png: 80 x 24 pixels, but the calibration is for 40 x 16"),
                    HasSubstr("rig.toml")));
}

TEST(CaptureEvents, RefusesTimesOutsideTheCapture) {
  const MadeCaptureFolder made;
  made.write_times(7200.05);
  EXPECT_THAT(events_error(made),
              AllOf(HasSubstr("times.txt: 10 of 10 times, 1700007200.050 s for the first"),
                    HasSubstr("lasts from 1700000000.001 to 1700000000.500 s")));
  made.write_times(0.35);
  EXPECT_THAT(events_error(made), HasSubstr("6 of 10 times"));
  made.write_times(0.2);
  EXPECT_EQ(events_error(made), "opened") << "a camera may stop later than the capture";
}

TEST(CaptureEvents, RefusesACaptureWithoutPackets) {
  const MadeCaptureFolder made;
  testing::write_capture(made.folder / "lidar.pcap", MadeCapture());
  EXPECT_THAT(events_error(made), HasSubstr("no data packets of a VLP-16"));
  testing::write_file(made.folder / "lidar.pcap", "something else");
  EXPECT_THAT(events_error(made), HasSubstr("lidar.pcap: not a capture file"));
}

TEST(CaptureEvents, TellsACaptureThatWasCutOff) {
  const MadeCaptureFolder made;
  testing::truncate_file(made.folder / "lidar.pcap", 0.97);
  auto events = events_of(made);
  ASSERT_TRUE(events) << events.error().message;
  EXPECT_NE((*events)->summary().damage, "");
  EXPECT_EQ((*events)->summary().packets, 365U);
}

// The machine that captured was 100 s behind and slow to stamp; the images are on the LiDAR's time.
TEST(CaptureEvents, PutsPacketsOnTheLidarsOwnClockWhereTheTimesAreOfIt) {
  const MadeCaptureFolder made;
  MadeCapture capture;
  for (std::uint32_t i = 0; i < 377; ++i) {
    MadeCaptureFolder::add_packet(capture, i, i % 7 * 300, 100'000'000);
  }
  const PositionPayload position = write_position_packet(
      static_cast<std::uint32_t>((kPastHour + 101) * 1'000'000), PpsState::kLocked,
      "$GPRMC,223140,A,4807.038,N,01131.000,E,,,141123,,*");
  testing::write_capture(made.folder / "lidar.pcap", capture);
  made.write_times(100.05);
  EXPECT_THAT(events_error(made), HasSubstr("lie outside"));
  made.write_times(100.05, "# clock: lidar\n");
  auto events = events_of(made, {.packet_delay = 100us});
  ASSERT_TRUE(events) << events.error().message;
  const CapturedThings read = read_capture(**events);
  for (std::size_t i = 0; i < read.packets.size(); ++i) {
    const double late =
        to_seconds(read.packets[i].arrival.time_since_epoch() - (kCaptureSecond + 100) * 1s) -
        1e-6 * std::floor(static_cast<double>(i) * 1327.104);
    EXPECT_NEAR(late, 1306.368e-6 + 100e-6, 1e-9);
  }
  capture.add(static_cast<std::uint32_t>(kCaptureSecond) + 1, 0,
              testing::frame_of({.port = 8308, .payload = {position.begin(), position.end()}}));
  testing::write_capture(made.folder / "lidar.pcap", capture);
  EXPECT_THAT(events_error(made), HasSubstr("its clock ran free"))
      << "the sentence's checksum is missing";
}

}  // namespace
}  // namespace sparsight
