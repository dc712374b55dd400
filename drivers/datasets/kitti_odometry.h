#pragma once

#include <filesystem>
#include <optional>

#include "drivers/datasets/folder_source.h"
#include "hal/result.h"

namespace sparsight {

// The layout of the KITTI odometry benchmark (Geiger et al., CVPR 2012): image_0..3, velodyne,
// calib.txt, times.txt. Its scans are motion-compensated.
bool is_kitti_odometry(const std::filesystem::path& folder);
Result<FolderIndex> index_kitti_odometry(const std::filesystem::path& folder,
                                         std::optional<int> camera);

}  // namespace sparsight
