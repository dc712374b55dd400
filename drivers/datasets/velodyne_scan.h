#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hal/result.h"
#include "hal/sweep.h"

namespace sparsight {

// The points of a scan in the order of storage; rings and times are not in the file.
struct StoredScan {
  std::vector<LidarReturn> returns;
  std::size_t refused = 0;  // points that are not numbers, or farther than any LiDAR sees
};

// KITTI's .bin: x, y, z, intensity as little-endian 32-bit floats, nothing else (Geiger et al.
// 2013, Sec. 3). Points at the origin are firings without a return and are left out silently.
// `file` is for error messages.
Result<StoredScan> parse_velodyne_scan(std::string_view bytes, const std::string& file);

// The scans of KITTI's unsynchronised drives: the same four numbers in text, one point a line.
Result<StoredScan> parse_velodyne_text(std::string_view text, const std::string& file);

}  // namespace sparsight
