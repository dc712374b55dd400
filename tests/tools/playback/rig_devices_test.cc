#include "tools/playback/rig_devices.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "drivers/vlp16/udp_receiver.h"
#include "tools/playback/packet_sender.h"
#include "tools/playback/simulated_line.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;

TEST(RigOnDevices, KeepsTheCalibrationAndNamesTheDevices) {
  RigConfig recorded;
  recorded.calibration.camera.fx = 123.0;
  recorded.camera.device = "simulated";
  recorded.camera.exposure = std::chrono::microseconds(4000);
  recorded.camera.controls.push_back({"Power Line Frequency", 0});
  recorded.trigger.exposure_line = 3;
  recorded.trigger.pps_line = 4;
  const RigConfig rig = rig_on_devices(
      recorded,
      {.camera = "/dev/video7", .chip = "/dev/gpiochip2", .sensor_address = "192.168.1.201"});
  EXPECT_EQ(rig.calibration.camera.fx, 123.0);
  EXPECT_EQ(rig.camera.device, "/dev/video7");
  EXPECT_FALSE(rig.camera.exposure) << "a loopback has no controls";
  EXPECT_TRUE(rig.camera.controls.empty());
  EXPECT_EQ(rig.trigger.chip, "/dev/gpiochip2");
  EXPECT_EQ(rig.trigger.exposure_line, 3U);
  EXPECT_EQ(rig.trigger.pps_line, 4U);
  EXPECT_EQ(rig.lidar.sensor_address, "192.168.1.201");
}

std::string word_in(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

TEST(SimulatedLine, PullsTheLineOfItsChip) {
  const fs::path sysfs = fs::path(::testing::TempDir()) / "simulated_line";
  fs::create_directories(sysfs / "gpiochip2" / "sim_gpio5");
  const fs::path pull = sysfs / "gpiochip2" / "sim_gpio5" / "pull";
  std::ofstream(pull) << "";
  auto line = SimulatedLine::open("/dev/gpiochip2", 5, sysfs);
  ASSERT_TRUE(line) << line.error().message;
  EXPECT_EQ(word_in(pull), "pull-down");
  EXPECT_FALSE(line->is_high());
  fs::resize_file(pull, 0);  // sysfs takes each write as a whole
  EXPECT_EQ(line->pull(true), 0);
  EXPECT_EQ(word_in(pull), "pull-up");
  EXPECT_TRUE(line->is_high());
}

TEST(SimulatedLine, OneThatIsNotSimulatedIsRefusedByName) {
  const auto line = SimulatedLine::open("/dev/gpiochip9", 1, "/nowhere");
  ASSERT_FALSE(line);
  EXPECT_NE(line.error().message.find("/nowhere/gpiochip9/sim_gpio1/pull"), std::string::npos)
      << line.error().message;
}

TEST(PacketSender, SendsWhatItIsGiven) {
  auto receiver = UdpReceiver::open("127.0.0.1", 0, 1 << 16);
  ASSERT_TRUE(receiver) << receiver.error().message;
  auto sender = PacketSender::open("127.0.0.1");
  ASSERT_TRUE(sender) << sender.error().message;
  const std::vector<std::uint8_t> payload{1, 2, 3, 4};
  ASSERT_EQ(sender->send(payload, receiver->port()), 0);
  const auto received = receiver->receive();
  ASSERT_EQ(received.size(), 1U);
  EXPECT_TRUE(std::ranges::equal(received[0].payload, payload));
  EXPECT_EQ(received[0].source, 0x7f000001U);
}

TEST(PacketSender, RefusesWhatIsNoAddress) { EXPECT_FALSE(PacketSender::open("lidar")); }

}  // namespace
}  // namespace sparsight
