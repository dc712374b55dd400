#include "realtime/pipeline/device_stage.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>
#include <vector>

namespace sparsight {
namespace {

using namespace std::chrono_literals;

// A device that does as a script says: each read returns an edge, or leaves it in a state.
struct ScriptedDevice {
  std::vector<DeviceState> script;
  std::size_t at = 0;
  DeviceState state = DeviceState::kStopped;

  DeviceStage::Device device() {
    return {.kind = DeviceKind::kTrigger,
            .start = [this]() -> Result<void> {
              state = DeviceState::kStreaming;
              return {};
            },
            .read = [this]() -> std::optional<RigEvent> {
              if (at == script.size()) {
                state = DeviceState::kEnded;
                return std::nullopt;
              }
              state = script[at++];
              if (state != DeviceState::kStreaming) return std::nullopt;
              return Edge{EdgeLine::kExposure, true, HostTime(std::chrono::seconds(at))};
            },
            .stop = [] {},
            .state = [this] { return state; },
            .lost = [this] { return at / 2; }};
  }
};

std::vector<RigEvent> all_of(SpscQueue<RigEvent>& queue) {
  std::vector<RigEvent> events;
  RigEvent event;
  while (queue.consumer().try_pop(event)) events.push_back(event);
  return events;
}

void wait_for_end(const DeviceStage& stage) {
  for (int i = 0; i < 200 && !stage.ended(); ++i) std::this_thread::sleep_for(5ms);
}

TEST(DeviceStage, TellsOfASensorThatGoesAndComesBackAndLosesNothingElse) {
  using enum DeviceState;
  ScriptedDevice scripted{.script = {kStreaming, kStreaming, kSilent, kGone, kGone, kStreaming}};
  SetupRemarks remarks;
  DeviceStage stage(scripted.device(), 16, {.name = "scripted"}, remarks);
  stage.start();
  wait_for_end(stage);
  stage.stop();
  const std::vector<RigEvent> events = all_of(stage.to_recorder());
  std::vector<DeviceState> states;
  int edges = 0;
  for (const RigEvent& event : events) {
    edges += std::holds_alternative<Edge>(event);
    const auto* change = std::get_if<DeviceStateChange>(&event);
    if (change != nullptr) states.push_back(change->state);
  }
  EXPECT_EQ(edges, 3);
  EXPECT_EQ(states, (std::vector{kStreaming, kSilent, kGone, kStreaming}));
  EXPECT_EQ(all_of(stage.to_sync()).size(), events.size());
  EXPECT_EQ(stage.status().events, 3U);
  EXPECT_EQ(stage.status().lost, 3U) << "as the device says, half of what it was asked for";
}

TEST(DeviceStage, CountsForEachSideWhatItHadNoRoomFor) {
  ScriptedDevice scripted{.script = std::vector(20, DeviceState::kStreaming)};
  SetupRemarks remarks;
  DeviceStage stage(scripted.device(), 8, {.name = "scripted"}, remarks);
  stage.start();
  wait_for_end(stage);
  stage.stop();
  const DeviceStatus status = stage.status();
  EXPECT_EQ(status.events, 20U);
  EXPECT_EQ(status.not_recorded, 13U) << "of 20; one place went to the state";
  EXPECT_EQ(status.not_synchronized, 13U);
}

TEST(StageThread, SaysWhenItBreaksOffAndTheProgramGoesOn) {
  SetupRemarks remarks;
  StageThread thread({.name = "breaking"}, remarks);
  thread.start([] { throw std::runtime_error("no more memory"); });
  thread.stop();
  EXPECT_FALSE(thread.running());
  ASSERT_EQ(remarks.take().size(), 1U);
  remarks.add("again");
  remarks.add("again");
  EXPECT_EQ(remarks.take(), std::vector<std::string>{"again"});
}

}  // namespace
}  // namespace sparsight
