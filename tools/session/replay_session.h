#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "hal/result.h"
#include "slam/odometry.h"
#include "tools/session/session.h"

namespace sparsight {

struct ReplayOptions {
  std::filesystem::path source;
  std::optional<int> rays;    // all if not given
  std::optional<int> camera;  // the lowest that is there if not given
  std::string profile_name = "default";
  OdometryConfig config;
  std::optional<std::size_t> max_frames;
  std::optional<std::filesystem::path> output;
  std::optional<std::filesystem::path> ground_truth;  // else the one of the layout, if any
  bool map = true;
  bool quiet = false;  // no progress; faults are still told
};

struct ReplayResult {
  std::filesystem::path folder;
  Session session;
};

// Replays a source into a session folder. Fails if the source cannot be opened, the folder cannot
// be written, or no frame could be tracked; what was computed is written all the same.
Result<ReplayResult> replay_session(const ReplayOptions& options);

}  // namespace sparsight
