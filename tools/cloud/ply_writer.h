#pragma once

#include <filesystem>
#include <vector>

#include "hal/result.h"
#include "slam/map/voxel_map.h"

namespace sparsight {

// Binary little-endian PLY with x, y, z, red, green, blue and intensity: CloudCompare shows the
// intensity as a scalar field, MeshLab as vertex quality.
Result<void> write_ply(const std::filesystem::path& path, const std::vector<MapPoint>& points);

}  // namespace sparsight
