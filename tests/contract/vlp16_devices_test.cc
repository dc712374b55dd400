#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "drivers/vlp16/packet_writer.h"
#include "drivers/vlp16/pcap_lidar.h"
#include "drivers/vlp16/udp_lidar.h"
#include "tests/contract/device_under_test.h"
#include "tests/drivers/vlp16/loopback_sender.h"
#include "tests/drivers/vlp16/made_capture.h"
#include "tests/drivers/vlp16/made_packets.h"

namespace sparsight::contract {
namespace {

using namespace std::chrono_literals;

constexpr int kDataPackets = 20;
constexpr std::uint32_t kPacketMicroseconds = 1327;

DataPayload data_of(int i) {
  return testing::payload_of(
      {.microseconds_past_hour = static_cast<std::uint32_t>(i) * kPacketMicroseconds});
}
PositionPayload position_after(int i) {
  return write_position_packet(static_cast<std::uint32_t>(i) * kPacketMicroseconds,
                               PpsState::kAbsent, "");
}
bool position_follows(int i) { return i % 10 == 5; }

LidarUnderTest on_the_network() {
  LidarConfig config;
  config.sensor_address = config.bind_address = "127.0.0.1";
  config.data_port = config.position_port = 0;  // any free one
  auto lidar = std::make_unique<UdpLidar>(config, UdpLidarOptions{.silent_after = 500ms});
  auto sender = std::make_shared<testing::LoopbackSender>();
  LidarUnderTest test;
  test.world = sender;
  test.feed = [sender, receiver = lidar.get()] {
    for (int i = 0; i < kDataPackets; ++i) {
      sender->send(receiver->data_port(), data_of(i));
      if (position_follows(i)) sender->send(receiver->position_port(), position_after(i));
    }
  };
  test.device = std::move(lidar);
  return test;
}

// A capture that is gone with the test.
class CaptureFile {
 public:
  CaptureFile()
      : path_(std::filesystem::temp_directory_path() /
              ("sparsight_lidar_contract_" + std::to_string(getpid()) + "_" +
               std::to_string(count_++) + ".pcap")) {
    testing::MadeCapture capture;
    for (int i = 0; i < kDataPackets; ++i) {
      add(capture, i, 2368, data_of(i));
      if (position_follows(i)) add(capture, i, 8308, position_after(i));
    }
    std::ofstream file(path_, std::ios::binary);
    file.write(reinterpret_cast<const char*>(capture.bytes().data()),
               static_cast<std::streamsize>(capture.bytes().size()));
  }
  CaptureFile(const CaptureFile&) = delete;
  CaptureFile& operator=(const CaptureFile&) = delete;
  ~CaptureFile() { std::filesystem::remove(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  template <typename Payload>
  static void add(testing::MadeCapture& capture, int i, std::uint16_t port,
                  const Payload& payload) {
    capture.add(1, static_cast<std::uint32_t>(i) * kPacketMicroseconds,
                testing::frame_of({.port = port, .payload = {payload.begin(), payload.end()}}));
  }
  static inline int count_ = 0;  // several may be open at once
  std::filesystem::path path_;
};

LidarUnderTest in_a_capture() {
  auto file = std::make_shared<CaptureFile>();
  LidarUnderTest test;
  test.world = file;
  test.device = std::make_unique<PcapLidar>(file->path());
  return test;
}

const bool kUdpAdded = add_lidar({"Udp", on_the_network});
const bool kPcapAdded = add_lidar({"Pcap", in_a_capture, DeviceNature::kReplayed});

}  // namespace
}  // namespace sparsight::contract
