#pragma once

#include <filesystem>
#include <vector>

#include "hal/result.h"
#include "slam/map/voxel_map.h"

namespace sparsight {

// Binary PCD 0.7 with x, y, z, rgb and intensity, in the world frame. rgb is packed as PCL does it:
// the bits 0x00rrggbb of a float.
Result<void> write_pcd(const std::filesystem::path& path, const std::vector<MapPoint>& points);

}  // namespace sparsight
