#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hal/result.h"
#include "slam/odometry_config.h"
#include "tools/cloud/cloud_file.h"
#include "tools/map/session_map.h"
#include "tools/session/live_devices.h"
#include "tools/session/session.h"

namespace sparsight {

struct LiveOptions {
  std::string profile_name = "default";
  OdometryConfig config;
  std::filesystem::path folder;  // where the session goes; it exists and holds nothing
  bool odometry = true;          // false: record only
  bool recording = true;
  std::vector<CloudFormat> map = {CloudFormat::kPly};  // files of it; none: no map
  SessionMapOptions maps;                              // to go on in, and to leave
  bool realtime = true;
  bool json = false;
  bool quiet = false;
  std::optional<std::chrono::nanoseconds> duration;  // until it is asked to end, if not given
};

struct LiveResult {
  Session session;
  std::optional<Error> failure;
};

// Runs on the rig until it is asked to end (SIGINT, SIGTERM), the time is over or a recording that
// is played has ended; then lets every stage finish what it has, and writes the session. An error
// if it could not begin. Recording goes on whatever becomes of tracking, and tracking whatever
// becomes of the recording.
Result<LiveResult> run_live(LiveRig rig, const LiveOptions& options);

}  // namespace sparsight
