#include "hal/lidar.h"

#include "tests/contract/device_contract.h"

namespace sparsight::contract {
namespace {

HostTime arrival_of_message(const LidarMessage& message) {
  return std::visit([](const auto& packet) { return packet.arrival; }, message);
}

class LidarContract : public DeviceContract<Lidar> {};
SPARSIGHT_DEVICE_CONTRACT(LidarContract)

TEST_P(LidarContract, PacketsComeInTheOrderOfTheirArrival) {
  start();
  const auto messages = read_all(device());
  ASSERT_GE(messages.size(), 10U);
  for (std::size_t i = 1; i < messages.size(); ++i) {
    EXPECT_GE(arrival_of_message(messages[i]), arrival_of_message(messages[i - 1]));
  }
}

TEST_P(LidarContract, CountersAgreeWithWhatWasRead) {
  start();
  const auto messages = read_all(device());
  std::uint64_t packets = 0;
  for (const LidarMessage& message : messages) {
    packets += std::holds_alternative<LidarPacket>(message) ? 1 : 0;
  }
  EXPECT_GT(packets, 0U);
  EXPECT_EQ(device().counters().packets, packets);
  EXPECT_EQ(device().counters().positions, messages.size() - packets);
}

INSTANTIATE_TEST_SUITE_P(Lidars, LidarContract,
                         ::testing::ValuesIn(registered<Implementation<Lidar>>()),
                         NameOfImplementation());

}  // namespace
}  // namespace sparsight::contract
