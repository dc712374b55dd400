#include "hal/lidar.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>

#include "drivers/vlp16/pcap_lidar.h"
#include "drivers/vlp16/udp_lidar.h"
#include "tests/drivers/vlp16/loopback_sender.h"
#include "tests/drivers/vlp16/made_capture.h"
#include "tests/drivers/vlp16/made_packets.h"

// What every Lidar owes whoever reads it. A new implementation adds one line at the end.
namespace sparsight {
namespace {

using namespace std::chrono_literals;

constexpr int kDataPackets = 20;
constexpr int kPositionPackets = 2;
constexpr std::uint32_t kPacketMicroseconds = 1327;

// A LiDAR that has kDataPackets and kPositionPackets to give once it is started.
class LidarRig {
 public:
  virtual ~LidarRig() = default;
  virtual Lidar& lidar() = 0;
  virtual void feed() = 0;  // after each start
};

DataPayload data_of(int i) {
  return testing::payload_of(
      {.microseconds_past_hour = static_cast<std::uint32_t>(i) * kPacketMicroseconds});
}
PositionPayload position_of_half(int i) {
  return write_position_packet(static_cast<std::uint32_t>(i) * 10 * kPacketMicroseconds,
                               PpsState::kAbsent, "");
}

class NetworkRig final : public LidarRig {
 public:
  NetworkRig() : lidar_(config(), {.silent_after = 20ms}) {}
  Lidar& lidar() override { return lidar_; }
  void feed() override {
    for (int i = 0; i < kDataPackets; ++i) sender_.send(lidar_.data_port(), data_of(i));
    for (int i = 0; i < kPositionPackets; ++i) {
      sender_.send(lidar_.position_port(), position_of_half(i));
    }
  }

 private:
  static LidarConfig config() {
    LidarConfig config;
    config.sensor_address = config.bind_address = "127.0.0.1";
    config.data_port = config.position_port = 0;
    return config;
  }
  UdpLidar lidar_;
  testing::LoopbackSender sender_;
};

class CaptureRig final : public LidarRig {
 public:
  CaptureRig()
      : file_(std::filesystem::temp_directory_path() /
              ("sparsight_lidar_contract_" + std::to_string(getpid()) + ".pcap")),
        lidar_(file_) {
    testing::MadeCapture capture;
    for (int i = 0; i < kDataPackets; ++i) {
      add(capture, i, 2368, data_of(i));
      if (i % 10 == 5) add(capture, i, 8308, position_of_half(i / 10));
    }
    std::ofstream file(file_, std::ios::binary);
    file.write(reinterpret_cast<const char*>(capture.bytes().data()),
               static_cast<std::streamsize>(capture.bytes().size()));
  }
  ~CaptureRig() override { std::filesystem::remove(file_); }
  Lidar& lidar() override { return lidar_; }
  void feed() override {}

 private:
  template <typename Payload>
  static void add(testing::MadeCapture& capture, int i, std::uint16_t port,
                  const Payload& payload) {
    capture.add(1, static_cast<std::uint32_t>(i) * kPacketMicroseconds,
                testing::frame_of({.port = port, .payload = {payload.begin(), payload.end()}}));
  }
  std::filesystem::path file_;
  PcapLidar lidar_;
};

struct LidarImplementation {
  std::string name;
  std::function<std::unique_ptr<LidarRig>()> make;
};

class LidarContract : public ::testing::TestWithParam<LidarImplementation> {
 protected:
  void start() {
    ASSERT_TRUE(lidar_.start());
    rig_->feed();
  }
  std::vector<LidarMessage> all_messages() {
    std::vector<LidarMessage> messages;
    while (auto message = lidar_.read(200ms)) messages.push_back(std::move(*message));
    return messages;
  }
  std::unique_ptr<LidarRig> rig_ = GetParam().make();
  Lidar& lidar_ = rig_->lidar();
};

TEST_P(LidarContract, IsStoppedUntilItIsStarted) {
  EXPECT_EQ(lidar_.state(), DeviceState::kStopped);
  EXPECT_FALSE(lidar_.read(0ns));
  EXPECT_EQ(lidar_.counters().packets, 0U);
}

TEST_P(LidarContract, GivesWhatTheSensorSentUnaltered) {
  start();
  const auto messages = all_messages();
  ASSERT_EQ(messages.size(), static_cast<std::size_t>(kDataPackets + kPositionPackets));
  int data = 0;
  int positions = 0;
  for (const LidarMessage& message : messages) {
    if (const auto* packet = std::get_if<LidarPacket>(&message)) {
      EXPECT_EQ(packet->payload, data_of(data++));
    } else {
      EXPECT_EQ(std::get<PositionPacket>(message).payload, position_of_half(positions++));
    }
  }
}

TEST_P(LidarContract, GivesEachKindInTheOrderOfArrival) {
  start();
  HostTime last_data;
  HostTime last_position;
  for (const LidarMessage& message : all_messages()) {
    const bool is_data = std::holds_alternative<LidarPacket>(message);
    const HostTime arrival = is_data ? std::get<LidarPacket>(message).arrival
                                     : std::get<PositionPacket>(message).arrival;
    HostTime& last = is_data ? last_data : last_position;
    EXPECT_GE(arrival, last);
    EXPECT_GT(arrival, HostTime{}) << "a packet knows when it came";
    last = arrival;
  }
}

TEST_P(LidarContract, CountsWhatItGives) {
  start();
  all_messages();
  const LidarCounters counters = lidar_.counters();
  EXPECT_EQ(counters.packets, static_cast<std::uint64_t>(kDataPackets));
  EXPECT_EQ(counters.positions, static_cast<std::uint64_t>(kPositionPackets));
  EXPECT_EQ(counters.refused, 0U);
  EXPECT_EQ(counters.dropped, 0U);
}

TEST_P(LidarContract, StreamsWhileDataComeAndThenSaysThatTheyDoNot) {
  start();
  ASSERT_TRUE(lidar_.read(1s));
  EXPECT_EQ(lidar_.state(), DeviceState::kStreaming);
  all_messages();
  EXPECT_TRUE(lidar_.state() == DeviceState::kSilent || lidar_.state() == DeviceState::kEnded);
}

TEST_P(LidarContract, StopsAndStartsAgain) {
  start();
  ASSERT_TRUE(lidar_.read(1s));
  lidar_.stop();
  EXPECT_EQ(lidar_.state(), DeviceState::kStopped);
  EXPECT_FALSE(lidar_.read(0ns));
  start();
  EXPECT_EQ(all_messages().size(), static_cast<std::size_t>(kDataPackets + kPositionPackets));
  EXPECT_EQ(lidar_.counters().packets, static_cast<std::uint64_t>(kDataPackets))
      << "since the last start";
}

INSTANTIATE_TEST_SUITE_P(
    Implementations, LidarContract,
    ::testing::Values(LidarImplementation{"Network", [] { return std::make_unique<NetworkRig>(); }},
                      LidarImplementation{"Capture",
                                          [] { return std::make_unique<CaptureRig>(); }}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace sparsight
