#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <vector>

#include "hal/result.h"
#include "hal/time.h"

namespace sparsight {

// What a session's folder says of the places it has seen again. Frames by their sequence numbers.
struct SessionLoops {
  struct Loop {
    std::uint64_t frame = 0;
    std::uint64_t before = 0;
    Eigen::Isometry3d T_frame_before = Eigen::Isometry3d::Identity();
  };
  // Keyframes between which odometry was not interrupted; those of one part are connected by loops.
  struct Submap {
    std::uint64_t first_frame = 0;
    std::uint64_t part = 0;
  };
  std::vector<Loop> loops;
  std::size_t with_earlier_map = 0;  // loops besides those, with frames of another session
  std::vector<Submap> submaps;       // in their order; the first begins with the session
  std::vector<std::uint64_t> keyframes;
  std::map<std::uint64_t, HostTime> exposures;  // of all frames
};

// From session.json and frames.csv.
Result<SessionLoops> read_session_loops(const std::filesystem::path& folder);

}  // namespace sparsight
