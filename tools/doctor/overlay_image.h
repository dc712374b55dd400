#pragma once

#include <filesystem>

#include "hal/calibration.h"
#include "hal/frame_source.h"
#include "hal/image.h"
#include "hal/result.h"

namespace sparsight {

// The frame's image with the returns fired around its exposure, red near to blue far, and the depth
// edges as white rings: those are to lie where things end in the image.
ColorImage draw_overlay(const SynchronizedFrame& frame, const RigCalibration& rig);

Result<void> write_png(const std::filesystem::path& file, const ColorImage& image);

}  // namespace sparsight
