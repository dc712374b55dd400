#pragma once

#include "hal/camera.h"
#include "realtime/sync/grey_image.h"

namespace sparsight {

// Grey is the luma as it stands; colours by ITU-R BT.601 with limited range (16..235), as cameras
// for video deliver. The frame's format is kYuyv, kUyvy or kNv12 and its size has been checked.
ConvertedImage from_yuv(const CameraFrame& frame, bool with_color);

}  // namespace sparsight
