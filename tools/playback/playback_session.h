#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "drivers/simulated/simulation_options.h"
#include "hal/result.h"
#include "tools/playback/device_player.h"
#include "tools/playback/rig_devices.h"

namespace sparsight {

struct PlaybackOptions {
  std::filesystem::path recording;
  RigDeviceNames devices;
  std::filesystem::path write_rig;  // "": no file
  std::chrono::nanoseconds lead =
      std::chrono::seconds(3);  // from the rig's file to the first event
  SimulatedFaults faults;       // of which PlaybackFaults takes its part
  std::uint64_t seed = 1;
};

struct PlaybackReport {
  std::chrono::nanoseconds moved_by{0};  // of all times: played minus recorded
  PlayedCounts camera;
  PlayedCounts lidar;
  PlayedCounts trigger;
  std::vector<std::string> remarks;
  bool whole = true;  // not interrupted

  std::uint64_t refused() const { return camera.refused + lidar.refused + trigger.refused; }
};

// Plays a recording into the kernel's device interfaces, with its own timing; the rig that reads
// them is described in a file first. Ends early when it is interrupted.
Result<PlaybackReport> play_into_devices(const PlaybackOptions& options);

std::string playback_text(const PlaybackReport& report);
std::string playback_json(const PlaybackReport& report);

}  // namespace sparsight
