#pragma once

#include <filesystem>
#include <optional>

#include "drivers/datasets/folder_source.h"
#include "hal/result.h"

namespace sparsight {

// The layout of a KITTI raw drive (Geiger et al., IJRR 2013): image_00..03 and velodyne_points,
// each with data and timestamps; the calibration stands beside the drive. Scans are as measured.
bool is_kitti_raw(const std::filesystem::path& folder);
Result<FolderIndex> index_kitti_raw(const std::filesystem::path& folder, std::optional<int> camera);

}  // namespace sparsight
