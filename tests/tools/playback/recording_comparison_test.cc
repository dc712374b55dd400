#include "tools/playback/recording_comparison.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "tests/drivers/replay/listed_events.h"

namespace sparsight {
namespace {

using namespace std::chrono_literals;

constexpr auto kMovedBy = -500s;

CameraFrame frame_number(std::uint32_t number, HostTime at) {
  return {.sequence = number,
          .driver_time = at,
          .arrival = at + 3ms,
          .format = PixelFormat::kGrey8,
          .width = 4,
          .height = 1,
          .stride_bytes = 4,
          .bytes = {static_cast<std::uint8_t>(number), 1, 2, 3}};
}

// A recording of five exposures; `change` may alter or leave out (false) what came out.
struct Change {
  std::function<bool(CameraFrame&)> frame = [](CameraFrame&) { return true; };
  std::function<bool(LidarPacket&)> packet = [](LidarPacket&) { return true; };
  std::function<bool(Edge&)> edge = [](Edge&) { return true; };
};

std::vector<RigEvent> events(std::chrono::nanoseconds moved_by, const Change& change) {
  std::vector<RigEvent> all;
  for (std::uint32_t i = 0; i < 5; ++i) {
    const HostTime at = HostTime(1000s) + i * 33ms + moved_by;
    for (const bool rising : {true, false}) {
      Edge edge{EdgeLine::kExposure, rising, at + (rising ? 0ms : 4ms)};
      if (change.edge(edge)) all.emplace_back(edge);
    }
    LidarPacket packet{.arrival = at + 5ms};
    packet.payload[7] = static_cast<std::uint8_t>(i);
    if (change.packet(packet)) all.emplace_back(packet);
    CameraFrame frame = frame_number(i, at + 10ms);
    if (change.frame(frame)) all.emplace_back(std::make_shared<const CameraFrame>(frame));
  }
  return all;
}

RecordingComparison compared(const Change& change) {
  ListedEvents in(events(0s, {}));
  ListedEvents out(events(kMovedBy, change));
  return compare_events(in, out, kMovedBy);
}

TEST(RecordingComparison, FindsNothingWhereAllCameOutAsItWentIn) {
  const RecordingComparison result = compared({});
  EXPECT_TRUE(result.frames.all_equal());
  EXPECT_TRUE(result.packets.all_equal());
  EXPECT_FALSE(result.positions.all_equal()) << "there are none to be equal";
  EXPECT_EQ(result.exposures.matched, 10U);
  EXPECT_EQ(result.exposures.most_late, 0ns);
  EXPECT_EQ(result.worst_frame_stamp, 0ns);
  EXPECT_EQ(result.camera_starts, 1U);
  EXPECT_EQ(result.sequence_gaps, 0U);
}

TEST(RecordingComparison, SeesASingleByteOfAFrame) {
  const RecordingComparison result = compared({.frame = [](CameraFrame& frame) {
    if (frame.sequence == 3) frame.bytes[2] ^= 1U;
    return true;
  }});
  EXPECT_EQ(result.frames.foreign, 1U);
  EXPECT_EQ(result.frames.missing, 1U);
  EXPECT_EQ(result.frames.equal, 4U);
}

TEST(RecordingComparison, SeesAFrameOfAnotherShape) {
  const RecordingComparison result = compared({.frame = [](CameraFrame& frame) {
    if (frame.sequence == 0) std::swap(frame.width, frame.height);
    return true;
  }});
  EXPECT_EQ(result.frames.foreign, 1U);
}

TEST(RecordingComparison, SeesWhatIsMissing) {
  const RecordingComparison result = compared(
      {.frame = [](CameraFrame& frame) { return frame.sequence != 2; },
       .packet = [](LidarPacket& packet) { return packet.payload[7] != 4; },
       .edge = [](Edge& edge) { return edge.rising || edge.time > HostTime(500s) + 10ms; }});
  EXPECT_EQ(result.frames.missing, 1U);
  EXPECT_EQ(result.frames.foreign, 0U);
  EXPECT_EQ(result.sequence_gaps, 1U);
  EXPECT_EQ(result.packets.missing, 1U);
  EXPECT_EQ(result.exposures.in, 10U);
  EXPECT_EQ(result.exposures.matched, 9U);
}

TEST(RecordingComparison, TakesANumberGivenTwiceForNoLossOfItsOwn) {
  const RecordingComparison result = compared({.frame = [](CameraFrame& frame) {
    if (frame.sequence == 3) frame.sequence = 2;
    return true;
  }});
  EXPECT_EQ(result.sequence_gaps, 1U) << "the number it should have had";
}

TEST(RecordingComparison, SeesPacketsThatChangedPlaces) {
  const RecordingComparison result = compared({.packet = [](LidarPacket& packet) {
    auto& number = packet.payload[7];
    if (number == 1 || number == 2) number = static_cast<std::uint8_t>(3 - number);
    return true;
  }});
  EXPECT_EQ(result.packets.foreign + result.packets.missing, 2U);
}

TEST(RecordingComparison, MeasuresHowLateEdgesAndStampsAre) {
  const RecordingComparison result = compared({.frame =
                                                   [](CameraFrame& frame) {
                                                     frame.driver_time += 700ns;
                                                     return true;
                                                   },
                                               .edge =
                                                   [](Edge& edge) {
                                                     edge.time += edge.rising ? 5us : 90us;
                                                     return true;
                                                   }});
  EXPECT_EQ(result.worst_frame_stamp, 700ns);
  EXPECT_EQ(result.exposures.matched, 10U);
  EXPECT_EQ(result.exposures.least_late, 5us);
  EXPECT_EQ(result.exposures.most_late, 90us);
}

TEST(RecordingComparison, AnEdgeOfTheOtherDirectionIsNoMatch) {
  const RecordingComparison result = compared({.edge = [](Edge& edge) {
    edge.rising = !edge.rising;
    return true;
  }});
  EXPECT_EQ(result.exposures.matched, 0U);
}

}  // namespace
}  // namespace sparsight
