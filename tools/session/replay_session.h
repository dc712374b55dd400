#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hal/result.h"
#include "slam/odometry.h"
#include "tools/cloud/cloud_file.h"
#include "tools/map/session_map.h"
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
  bool no_loops = false;
  std::vector<CloudFormat> map = {CloudFormat::kPly};  // files of it; none: no map
  SessionMapOptions maps;                              // to go on in, and to leave
  bool quiet = false;                                  // no progress; faults are still told
};

struct ReplayResult {
  std::filesystem::path folder;
  Session session;
  std::optional<Error> failure;  // see failure_of()
};

// Replays a source into a session folder; what was computed until something failed is in it. An
// error if there is no session: the source cannot be opened, or the folder not be written.
Result<ReplayResult> replay_session(const ReplayOptions& options);

}  // namespace sparsight
