#pragma once

#include <chrono>

#include "drivers/v4l2/video_device.h"
#include "hal/rig_config.h"

namespace sparsight {

// Makes the camera what the configuration says: manual exposure and gain where they are given, then
// its list of controls. Gives the exposure time in force; 0 where the camera chooses or hides it.
Result<std::chrono::nanoseconds> apply_settings(VideoDevice& device, const CameraConfig& config);

}  // namespace sparsight
