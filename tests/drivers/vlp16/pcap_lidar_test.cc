#include "drivers/vlp16/pcap_lidar.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "drivers/vlp16/vlp16_decoder.h"
#include "tests/build_paths.h"
#include "tests/drivers/vlp16/made_capture.h"
#include "tests/drivers/vlp16/made_packets.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;
using testing::Bytes;
using testing::frame_of;
using testing::MadeCapture;

// A capture on disk, gone with the test.
class CaptureFile {
 public:
  explicit CaptureFile(const MadeCapture& capture)
      : path_(std::filesystem::temp_directory_path() /
              ("sparsight_pcap_lidar_test_" + std::to_string(getpid()) + ".pcap")) {
    std::ofstream file(path_, std::ios::binary);
    file.write(reinterpret_cast<const char*>(capture.bytes().data()),
               static_cast<std::streamsize>(capture.bytes().size()));
  }
  ~CaptureFile() { std::filesystem::remove(path_); }
  CaptureFile(const CaptureFile&) = delete;
  CaptureFile& operator=(const CaptureFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

Bytes data_payload() {
  const DataPayload payload = testing::payload_of({});
  return {payload.begin(), payload.end()};
}
Bytes position_payload() {
  const PositionPayload payload = write_position_packet(5, PpsState::kAbsent, "");
  return {payload.begin(), payload.end()};
}

TEST(PcapLidar, GivesBothKindsWithTheirCaptureStampsThenEnds) {
  MadeCapture capture;
  capture.add(10, 1, frame_of({.payload = data_payload()}));
  capture.add(10, 2, frame_of({.port = 8308, .payload = position_payload()}));
  const CaptureFile file(capture);
  PcapLidar lidar(file.path());
  EXPECT_EQ(lidar.state(), DeviceState::kStopped);
  EXPECT_FALSE(lidar.read(0s));
  ASSERT_TRUE(lidar.start());
  EXPECT_EQ(lidar.state(), DeviceState::kStreaming);
  const auto data = lidar.read(0s);
  ASSERT_TRUE(data);
  ASSERT_TRUE(std::holds_alternative<LidarPacket>(*data));
  EXPECT_EQ(std::get<LidarPacket>(*data).arrival, HostTime(10s + 1us));
  EXPECT_EQ(std::get<LidarPacket>(*data).payload, testing::payload_of({}));
  const auto position = lidar.read(0s);
  ASSERT_TRUE(position);
  EXPECT_EQ(std::get<PositionPacket>(*position).arrival, HostTime(10s + 2us));
  EXPECT_FALSE(lidar.read(0s));
  EXPECT_EQ(lidar.state(), DeviceState::kEnded);
  EXPECT_EQ(lidar.counters().packets, 1U);
  EXPECT_EQ(lidar.counters().positions, 1U);
  EXPECT_EQ(lidar.counters().refused, 0U);
  lidar.stop();
  EXPECT_EQ(lidar.state(), DeviceState::kStopped);
  ASSERT_TRUE(lidar.start());
  EXPECT_TRUE(lidar.read(0s)) << "from the beginning again";
}

TEST(PcapLidar, RefusesWrongSizesAndOtherSensors) {
  MadeCapture capture;
  Bytes short_payload = data_payload();
  short_payload.pop_back();
  capture.add(1, 0, frame_of({.payload = short_payload}));
  capture.add(2, 0, frame_of({.last_octet = 100, .payload = data_payload()}));
  capture.add(3, 0, frame_of({.last_octet = 101, .payload = data_payload()}));
  capture.add(4, 0, frame_of({.last_octet = 100, .port = 8308, .payload = data_payload()}));
  capture.add(5, 0, frame_of({.port = 53, .payload = data_payload()}));
  const CaptureFile file(capture);
  PcapLidar lidar(file.path());
  ASSERT_TRUE(lidar.start());
  const auto message = lidar.read(0s);
  ASSERT_TRUE(message);
  EXPECT_EQ(std::get<LidarPacket>(*message).arrival, HostTime(2s));
  EXPECT_FALSE(lidar.read(0s));
  EXPECT_EQ(lidar.counters().refused, 3U);
}

TEST(PcapLidar, SaysWhichFileIsMissing) {
  PcapLidar lidar("/nowhere/walk.pcap");
  const auto started = lidar.start();
  ASSERT_FALSE(started);
  EXPECT_NE(started.error().message.find("/nowhere/walk.pcap"), std::string::npos);
  EXPECT_EQ(lidar.state(), DeviceState::kStopped);
}

TEST(PcapLidar, ReadsARealCaptureWithGps) {
  const auto file = testing::recordings() / "vlp16/vlp16_gps.pcap";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no recording (SPARSIGHT_DATA)";
  PcapLidar lidar(file);
  ASSERT_TRUE(lidar.start());
  Vlp16Decoder decoder;
  DecodedPacket packet;
  int utc_reports = 0;
  while (const auto message = lidar.read(0s)) {
    if (const auto* data = std::get_if<LidarPacket>(&*message)) {
      ASSERT_TRUE(decoder.decode(*data, packet));
      continue;
    }
    const auto report = decoder.decode(std::get<PositionPacket>(*message));
    ASSERT_TRUE(report);
    EXPECT_EQ(report->pps, PpsState::kLocked);
    utc_reports += report->utc_valid ? 1 : 0;
    // Both kinds of stamps are of one clock.
    EXPECT_LT(std::abs(to_seconds(report->time - SensorTime(1082340595us))), 0.5);
  }
  EXPECT_EQ(lidar.counters().packets, 293U);
  EXPECT_EQ(lidar.counters().positions, 57U);
  EXPECT_EQ(lidar.counters().refused, 0U);
  EXPECT_EQ(utc_reports, 57);
  EXPECT_EQ(decoder.counters().decoded, 293U);
  EXPECT_EQ(decoder.counters().lost, 0U);
  EXPECT_EQ(decoder.counters().clock_jumps, 0U);
}

}  // namespace
}  // namespace sparsight
