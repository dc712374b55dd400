#pragma once

#include <cstddef>

#include "drivers/v4l2/video_device.h"
#include "hal/camera.h"
#include "hal/rig_config.h"

namespace sparsight {

// What camera and driver agreed to deliver.
struct AgreedFormat {
  PixelFormat format = PixelFormat::kGrey8;
  int width = 0;
  int height = 0;
  int stride_bytes = 0;  // 0 for kMjpeg
  double rate_hz = 0.0;  // 0: the driver does not say
};

// Takes the format asked for, or the first in the order of PixelFormat that the camera offers *at
// the size asked for*: drivers give another size without a word (V4L2, VIDIOC_S_FMT).
Result<AgreedFormat> agree_on_format(VideoDevice& device, const CameraConfig& config);

}  // namespace sparsight
