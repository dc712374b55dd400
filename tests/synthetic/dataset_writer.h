#pragma once

#include <filesystem>
#include <functional>

#include "hal/result.h"
#include "tests/synthetic/scene.h"

namespace sparsight::synthetic {

using Progress = std::function<void(std::size_t frame)>;

// KITTI odometry: root/sequences/NN/{image_0,velodyne,calib.txt,times.txt}, root/poses/NN.txt.
// Returns the sequence's folder.
Result<std::filesystem::path> write_odometry_folder(const Scene& scene, std::size_t frames,
                                                    const std::filesystem::path& root,
                                                    const Progress& progress = {});

// KITTI raw: root/2011_09_26/2011_09_26_drive_0001_sync/..., the calibration files above it, and
// poses_camera_0.txt (true poses, the first is the identity) in the drive. Returns the drive.
Result<std::filesystem::path> write_raw_folder(const Scene& scene, std::size_t frames,
                                               const std::filesystem::path& root,
                                               const Progress& progress = {});

}  // namespace sparsight::synthetic
