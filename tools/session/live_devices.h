#pragma once

#include <filesystem>
#include <string>

#include "hal/result.h"
#include "hal/rig_config.h"
#include "realtime/pipeline/live_pipeline.h"

namespace sparsight {

// A rig to run on, its devices not started.
struct LiveRig {
  RigConfig config;
  std::filesystem::path source;  // the rig's file, or the recording that is played
  LiveDevices devices;
};

// The devices that the rig's file names.
Result<LiveRig> open_rig(const std::string& rig_file);

// A recording as if it happened now, with its own timing: its events reach the devices' interfaces
// when they arrived; `times` over. rig_file: instead of the recording's own description of its rig,
// if not "".
Result<LiveRig> play_recording(const std::filesystem::path& recording, const std::string& rig_file,
                               int times = 1);

}  // namespace sparsight
