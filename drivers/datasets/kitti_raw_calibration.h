#pragma once

#include <filesystem>

#include "drivers/datasets/image_folder.h"
#include "hal/calibration.h"
#include "hal/result.h"

namespace sparsight {

// From calib_cam_to_cam.txt and calib_velo_to_cam.txt, in the folder of the day. Rectified images
// (..._sync) are those of P_rect, images as taken (..._extract, or of the size S_0N) those of K and
// D.
Result<RigCalibration> read_kitti_raw_calibration(const std::filesystem::path& drive,
                                                  const ImageFolder& images);

}  // namespace sparsight
