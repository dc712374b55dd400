#include "drivers/vlp16/udp_lidar.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/drivers/vlp16/loopback_sender.h"
#include "tests/drivers/vlp16/made_packets.h"

// A sensor on the loopback interface.
namespace sparsight {
namespace {

using namespace std::chrono_literals;
using testing::payload_of;
using Sender = testing::LoopbackSender;

LidarConfig loopback() {
  LidarConfig config;
  config.sensor_address = "127.0.0.1";
  config.bind_address = "127.0.0.1";
  config.data_port = 0;
  config.position_port = 0;
  return config;
}

DataPayload numbered(std::uint32_t number) {
  return payload_of({.microseconds_past_hour = number});
}
std::uint32_t number_of(const LidarPacket& packet) {
  return packet.payload[1200] + 256U * packet.payload[1201];
}

// The kernel begins to stamp datagrams a little after the first socket has asked for it, and stamps
// those that were not when they are read. This one asks early, for all tests.
class UdpLidarOnLoopback : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    ASSERT_TRUE(asked_early().start());
    usleep(50'000);
  }
  static void TearDownTestSuite() { asked_early().stop(); }

 private:
  static UdpLidar& asked_early() {
    static UdpLidar lidar(loopback());
    return lidar;
  }
};

TEST_F(UdpLidarOnLoopback, GivesBothPortsInTheOrderOfArrival) {
  UdpLidar lidar(loopback());
  ASSERT_TRUE(lidar.start());
  const Sender sensor;
  const auto position = write_position_packet(77, PpsState::kLocked, "");
  const HostTime before = read_clocks().monotonic;
  sensor.send(lidar.data_port(), numbered(1));
  sensor.send(lidar.position_port(), position);
  sensor.send(lidar.data_port(), numbered(2));
  const auto first = lidar.read(1s);
  const auto second = lidar.read(1s);
  const auto third = lidar.read(1s);
  const HostTime after = read_clocks().monotonic;
  ASSERT_TRUE(first && second && third);
  EXPECT_EQ(number_of(std::get<LidarPacket>(*first)), 1U);
  EXPECT_EQ(std::get<PositionPacket>(*second).payload, position);
  EXPECT_EQ(number_of(std::get<LidarPacket>(*third)), 2U);
  // The kernel's stamps lie on the project's clock.
  EXPECT_GT(std::get<LidarPacket>(*first).arrival, before - 1ms);
  EXPECT_LT(std::get<LidarPacket>(*first).arrival, std::get<PositionPacket>(*second).arrival);
  EXPECT_LT(std::get<PositionPacket>(*second).arrival, std::get<LidarPacket>(*third).arrival);
  EXPECT_LE(std::get<LidarPacket>(*third).arrival, after);
  EXPECT_EQ(lidar.counters().packets, 2U);
  EXPECT_EQ(lidar.counters().positions, 1U);
}

TEST_F(UdpLidarOnLoopback, ArrivalIsTheKernelsStampNotTheTimeOfReading) {
  UdpLidar lidar(loopback());
  ASSERT_TRUE(lidar.start());
  const Sender sensor;
  // The kernel begins to stamp some milliseconds after it is asked to.
  sensor.send(lidar.data_port(), numbered(0));
  ASSERT_TRUE(lidar.read(1s));
  usleep(100'000);
  sensor.send(lidar.data_port(), numbered(1));
  const HostTime sent = read_clocks().monotonic;
  usleep(400'000);
  const auto message = lidar.read(1s);
  ASSERT_TRUE(message);
  EXPECT_LT(std::get<LidarPacket>(*message).arrival, sent + 200ms);
}

TEST_F(UdpLidarOnLoopback, TakesManyInTheirOrder) {
  UdpLidar lidar(loopback());
  ASSERT_TRUE(lidar.start());
  const Sender sensor;
  std::uint32_t expected = 0;
  for (std::uint32_t sent = 0; sent < 400;) {
    for (int i = 0; i < 40; ++i) sensor.send(lidar.data_port(), numbered(sent++));
    while (expected < sent) {
      const auto message = lidar.read(1s);
      ASSERT_TRUE(message);
      ASSERT_EQ(number_of(std::get<LidarPacket>(*message)), expected++);
    }
  }
  EXPECT_EQ(lidar.counters().dropped, 0U);
}

TEST_F(UdpLidarOnLoopback, RefusesOtherSenders) {
  UdpLidar lidar(loopback());
  ASSERT_TRUE(lidar.start());
  const Sender stranger("127.0.0.2");
  stranger.send(lidar.data_port(), numbered(1));
  stranger.send(lidar.position_port(), write_position_packet(0, PpsState::kLocked, ""));
  EXPECT_FALSE(lidar.read(20ms));
  EXPECT_EQ(lidar.counters().refused, 2U);
  EXPECT_EQ(lidar.state(), DeviceState::kSilent) << "a stranger does not make the sensor speak";
}

TEST_F(UdpLidarOnLoopback, TakesAnySenderIfNoneIsNamed) {
  LidarConfig config = loopback();
  config.sensor_address.clear();
  UdpLidar lidar(config);
  ASSERT_TRUE(lidar.start());
  Sender("127.0.0.2").send(lidar.data_port(), numbered(1));
  EXPECT_TRUE(lidar.read(1s));
}

TEST_F(UdpLidarOnLoopback, RefusesEveryOtherSize) {
  UdpLidar lidar(loopback());
  ASSERT_TRUE(lidar.start());
  const Sender sensor;
  const auto payload = numbered(1);
  std::vector<std::uint8_t> bytes(payload.begin(), payload.end());
  bytes.push_back(0);
  sensor.send(lidar.data_port(), bytes);  // what fits into the buffer would pass for a packet
  bytes.resize(1205);
  sensor.send(lidar.data_port(), bytes);
  sensor.send(lidar.data_port(), std::vector<std::uint8_t>{});
  bytes.resize(512);
  sensor.send(lidar.data_port(), bytes);
  bytes.resize(513);
  sensor.send(lidar.position_port(), bytes);
  EXPECT_FALSE(lidar.read(20ms));
  EXPECT_EQ(lidar.counters().refused, 5U);
  EXPECT_EQ(lidar.counters().packets, 0U);
}

TEST_F(UdpLidarOnLoopback, GoesSilentAndComesBack) {
  UdpLidar lidar(loopback(), {.silent_after = 400ms});
  EXPECT_EQ(lidar.state(), DeviceState::kStopped);
  EXPECT_FALSE(lidar.read(0s));
  ASSERT_TRUE(lidar.start());
  EXPECT_EQ(lidar.state(), DeviceState::kSilent);
  const Sender sensor;
  sensor.send(lidar.data_port(), numbered(1));
  EXPECT_TRUE(lidar.read(1s));
  EXPECT_EQ(lidar.state(), DeviceState::kStreaming);
  EXPECT_FALSE(lidar.read(1ms));
  EXPECT_EQ(lidar.state(), DeviceState::kStreaming) << "a gap is not silence";
  EXPECT_FALSE(lidar.read(500ms));
  EXPECT_EQ(lidar.state(), DeviceState::kSilent);
  sensor.send(lidar.position_port(), write_position_packet(0, PpsState::kLocked, ""));
  EXPECT_TRUE(lidar.read(1s));
  EXPECT_EQ(lidar.state(), DeviceState::kSilent) << "positions are no scan";
  sensor.send(lidar.data_port(), numbered(2));
  EXPECT_TRUE(lidar.read(1s));
  EXPECT_EQ(lidar.state(), DeviceState::kStreaming);
  lidar.stop();
  EXPECT_EQ(lidar.state(), DeviceState::kStopped);
}

TEST_F(UdpLidarOnLoopback, ReturnsAfterItsPatience) {
  UdpLidar lidar(loopback());
  ASSERT_TRUE(lidar.start());
  const HostTime before = read_clocks().monotonic;
  EXPECT_FALSE(lidar.read(20ms));
  const auto waited = read_clocks().monotonic - before;
  EXPECT_GE(waited, 20ms);
  EXPECT_LT(waited, 2s);
}

TEST_F(UdpLidarOnLoopback, CountsWhatTheKernelDropped) {
  UdpLidar lidar(loopback(), {.receive_buffer_bytes = 1});  // the kernel's minimum
  ASSERT_TRUE(lidar.start());
  const Sender sensor;
  constexpr std::uint32_t kSent = 100;
  for (std::uint32_t i = 0; i < kSent; ++i) sensor.send(lidar.data_port(), numbered(i));
  while (lidar.read(0s)) continue;
  // The count comes with the next datagram.
  sensor.send(lidar.data_port(), numbered(kSent));
  EXPECT_TRUE(lidar.read(1s));
  EXPECT_GT(lidar.counters().dropped, 0U);
  EXPECT_EQ(lidar.counters().dropped + lidar.counters().packets, kSent + 1);
}

TEST_F(UdpLidarOnLoopback, SaysWhyItCannotStart) {
  UdpLidar first(loopback());
  ASSERT_TRUE(first.start());
  LidarConfig taken = loopback();
  taken.data_port = first.data_port();
  UdpLidar second(taken);
  const auto started = second.start();
  ASSERT_FALSE(started);
  EXPECT_NE(started.error().message.find("another program"), std::string::npos);
  EXPECT_EQ(second.state(), DeviceState::kStopped);

  LidarConfig elsewhere = loopback();
  elsewhere.bind_address = "203.0.113.7";
  const auto nowhere = UdpLidar(elsewhere).start();
  ASSERT_FALSE(nowhere);
  EXPECT_NE(nowhere.error().message.find("lidar.bind_address"), std::string::npos);

  LidarConfig unreadable = loopback();
  unreadable.sensor_address = "sensor";
  const auto named = UdpLidar(unreadable).start();
  ASSERT_FALSE(named);
  EXPECT_NE(named.error().message.find("lidar.sensor_address"), std::string::npos);
}

TEST_F(UdpLidarOnLoopback, CanBeStartedAgain) {
  UdpLidar lidar(loopback());
  ASSERT_TRUE(lidar.start());
  ASSERT_TRUE(lidar.start());
  const Sender sensor;
  sensor.send(lidar.data_port(), numbered(1));
  EXPECT_TRUE(lidar.read(1s));
}

TEST_F(UdpLidarOnLoopback, NamesTheInterfaceTowardsTheSensor) {
  UdpLidar lidar(loopback());
  ASSERT_TRUE(lidar.start());
  EXPECT_EQ(lidar.system_folder(), "/sys/class/net/lo");
  LidarConfig anyone = loopback();
  anyone.sensor_address = "";
  UdpLidar of_anyone(anyone);
  ASSERT_TRUE(of_anyone.start());
  EXPECT_EQ(of_anyone.system_folder(), "");
}

}  // namespace
}  // namespace sparsight
