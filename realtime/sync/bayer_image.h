#pragma once

#include "hal/camera.h"
#include "realtime/sync/grey_image.h"

namespace sparsight {

// Bilinear demosaic; grey is the luma of its colours (ITU-R BT.601 weights). The frame's format is
// one of the Bayer ones and its size has been checked.
ConvertedImage from_bayer(const CameraFrame& frame, bool with_color);

}  // namespace sparsight
