#include "drivers/simulated/simulated_devices.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "drivers/recording/recording_source.h"
#include "drivers/recording/recording_writer.h"
#include "drivers/replay/replayed_devices.h"
#include "tests/contract/device_under_test.h"
#include "tests/drivers/simulated/bare_room.h"

// The simulated rig's devices, and those of a recording of it: what is written against the one must
// run on the others.
namespace sparsight::contract {
namespace {

using namespace std::chrono_literals;

SimulationOptions half_a_second(bool in_trouble) {
  SimulationOptions options = testing::small_options(0.5);
  if (!in_trouble) return options;
  options.faults.lost_edges = 0.1;
  options.faults.lost_frames = 0.1;
  options.faults.lost_packets = 0.05;
  options.faults.lidar_clock_jump = {.at = 250ms, .by = 3s};
  options.faults.away = {{DeviceKind::kCamera, 200ms, 100ms},
                         {DeviceKind::kLidar, 300ms, 60ms},
                         {DeviceKind::kTrigger, 100ms, 80ms}};
  return options;
}

std::unique_ptr<SimulatedRig> simulated_rig(bool in_trouble) {
  return std::make_unique<SimulatedRig>(half_a_second(in_trouble), testing::bare_room());
}

template <typename Device>
DeviceUnderTest<Device> simulated(bool in_trouble,
                                  std::unique_ptr<Device> (SimulatedDevices::*device)()) {
  SimulatedDevices devices(simulated_rig(in_trouble), half_a_second(in_trouble).start);
  return {.device = (devices.*device)()};
}

// Recorded once; gone with the program.
class RecordedWalk {
 public:
  RecordedWalk()
      : path_(std::filesystem::temp_directory_path() /
              ("sparsight_device_contract_" + std::to_string(getpid()) + ".mcap")) {
    std::filesystem::remove(path_);
    const auto rig = simulated_rig(true);
    auto writer = RecordingWriter::create(path_, {}, {.sync_chunks = false}).value();
    while (const auto event = rig->next()) EXPECT_TRUE(writer->write(*event));
    EXPECT_TRUE(writer->close());
  }
  RecordedWalk(const RecordedWalk&) = delete;
  RecordedWalk& operator=(const RecordedWalk&) = delete;
  ~RecordedWalk() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

Result<std::unique_ptr<RigEventSource>> open_recorded_walk() {
  static const RecordedWalk kWalk;
  return RecordingSource::open(kWalk.path());
}

bool add_simulated(const std::string& name, bool in_trouble) {
  add_event_source({name, [=] { return simulated_rig(in_trouble); }});
  add_camera({name, [=] { return simulated<Camera>(in_trouble, &SimulatedDevices::camera); },
              DeviceNature::kReplayed});
  add_lidar({name, [=] { return simulated<Lidar>(in_trouble, &SimulatedDevices::lidar); },
             DeviceNature::kReplayed});
  return add_trigger_line(
      {name, [=] { return simulated<TriggerLine>(in_trouble, &SimulatedDevices::trigger_line); },
       DeviceNature::kReplayed});
}

bool add_recorded() {
  add_event_source({"Recorded", [] { return open_recorded_walk().value(); }});
  add_camera({"Recorded",
              [] {
                return CameraUnderTest{.device =
                                           std::make_unique<ReplayedCamera>(open_recorded_walk)};
              },
              DeviceNature::kReplayed});
  add_lidar(
      {"Recorded",
       [] { return LidarUnderTest{.device = std::make_unique<ReplayedLidar>(open_recorded_walk)}; },
       DeviceNature::kReplayed});
  return add_trigger_line({"Recorded",
                           [] {
                             return TriggerLineUnderTest{
                                 .device =
                                     std::make_unique<ReplayedTriggerLine>(open_recorded_walk)};
                           },
                           DeviceNature::kReplayed});
}

const bool kSimulatedAdded = add_simulated("Simulated", false);
const bool kSimulatedInTroubleAdded = add_simulated("SimulatedInTrouble", true);
const bool kRecordedAdded = add_recorded();

}  // namespace
}  // namespace sparsight::contract
