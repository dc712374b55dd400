#include <gtest/gtest.h>

#include "drivers/vlp16/data_packet.h"
#include "drivers/vlp16/vlp16_decoder.h"
#include "tests/drivers/simulated/bare_room.h"

namespace sparsight {
namespace {

using testing::SimulatedEvents;
using testing::small_options;

SimulatedEvents events_with(ReturnMode mode) {
  SimulationOptions options = small_options(0.3);
  options.return_mode = mode;
  return testing::events_in_bare_room(options);
}

struct DecodedRoom {
  std::size_t returns = 0;
  DecoderCounters counters;
};
DecodedRoom decoded(const SimulatedEvents& events) {
  Vlp16Decoder decoder;
  DecodedPacket packet;
  DecodedRoom room;
  for (const LidarPacket& raw : events.packets) {
    if (decoder.decode(raw, packet)) room.returns += packet.returns.size();
  }
  room.counters = decoder.counters();
  return room;
}

TEST(SimulatedReturnModes, DualPacketsComeTwiceAsOftenAndTellTheOtherEchoesAtEdges) {
  const SimulatedEvents single = events_with(ReturnMode::kStrongest);
  const SimulatedEvents dual = events_with(ReturnMode::kDual);
  EXPECT_NEAR(static_cast<double>(dual.packets.size()),
              2.0 * static_cast<double>(single.packets.size()), 2.0);
  EXPECT_NEAR(static_cast<double>(dual.positions.size()),
              static_cast<double>(single.positions.size()), 1.0);
  const DecodedRoom one = decoded(single);
  const DecodedRoom two = decoded(dual);
  EXPECT_EQ(two.counters.refused + two.counters.lost + two.counters.clock_jumps, 0U);
  // The column's two sides, in each ring, three times round.
  EXPECT_GT(two.returns, one.returns + 30);
  EXPECT_LT(two.returns, one.returns * 11 / 10);
}

TEST(SimulatedReturnModes, TheTwoEchoesOfAFiringLieApart) {
  DataPacket reading;
  std::size_t seconds = 0;
  for (const LidarPacket& packet : events_with(ReturnMode::kDual).packets) {
    ASSERT_TRUE(read_data_packet(packet.payload, reading));
    ASSERT_EQ(reading.mode, ReturnMode::kDual);
    for (std::size_t s = 0; s < reading.sequence_count; ++s) {
      for (std::size_t laser = 0; laser < kVlp16Lasers; ++laser) {
        const int last = reading.sequences[s].echoes[laser].distance_2mm;
        const int other = reading.sequences[s].second_echoes[laser].distance_2mm;
        if (other == 0) continue;
        ++seconds;
        EXPECT_GT(last, other + 400) << "the last is the farther one, by a metre but for noise";
      }
    }
  }
  EXPECT_GT(seconds, 30U);
}

TEST(SimulatedReturnModes, TheLastSeesFartherThanTheStrongest) {
  const auto mean_range = [](ReturnMode mode) {
    DataPacket reading;
    double sum = 0.0;
    double count = 0.0;
    for (const LidarPacket& packet : events_with(mode).packets) {
      EXPECT_TRUE(read_data_packet(packet.payload, reading));
      EXPECT_EQ(reading.mode, mode);
      for (const Echo& echo : reading.sequences[0].echoes) sum += echo.distance_2mm;
      count += kVlp16Lasers;
    }
    return sum / count;
  };
  EXPECT_GT(mean_range(ReturnMode::kLast), mean_range(ReturnMode::kStrongest));
}

}  // namespace
}  // namespace sparsight
