#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/result.h"
#include "hal/time.h"

namespace sparsight {

enum class TrajectoryFormat : std::uint8_t {
  kKitti,  // 12 numbers a line: the upper 3x4 of T_world_camera, row by row; one line per frame
  kTum,    // t tx ty tz qx qy qz qw, seconds and metres; lines that start with # are comments
};

// Poses as a file gave them. Rotations keep the digits of the file: a KITTI file rounds to seven,
// so they are rotations only up to 1e-6 until something makes them so (see with_exact_rotations).
struct Trajectory {
  std::string source;                    // file name, for messages
  std::vector<Eigen::Isometry3d> poses;  // T_world_camera
  std::vector<HostTime> times;           // one per pose, never decreasing; empty: index is all
};

// Pure functions over the text of a file; `source` only names it in errors. Without a format it is
// told by the first line: 12 numbers or 8.
Result<Trajectory> parse_trajectory(std::string_view text, const std::string& source,
                                    std::optional<TrajectoryFormat> format = std::nullopt);
// KITTI times.txt: seconds, one number per line and frame, increasing.
Result<std::vector<HostTime>> parse_times(std::string_view text, const std::string& source);

Result<Trajectory> read_trajectory(const std::filesystem::path& file,
                                   std::optional<TrajectoryFormat> format = std::nullopt);
Result<std::vector<HostTime>> read_times(const std::filesystem::path& file);

// Every digit needed to read the same doubles back. The TUM form needs times.
std::string format_kitti(const std::vector<Eigen::Isometry3d>& poses);
inline constexpr const char* kTumHeader = "# t tx ty tz qx qy qz qw\n";
std::string tum_line(HostTime time, const Eigen::Isometry3d& T_world_camera);
std::string format_tum(const Trajectory& trajectory);

// Gives a trajectory without times those of its frames; refuses if there are fewer times than
// poses.
Result<Trajectory> with_times(Trajectory trajectory, const std::vector<HostTime>& times,
                              const std::string& times_source);

// Each rotation replaced by the nearest true one.
Trajectory with_exact_rotations(Trajectory trajectory);

}  // namespace sparsight
