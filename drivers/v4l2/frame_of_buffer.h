#pragma once

#include <linux/videodev2.h>

#include <cstdint>
#include <span>

#include "drivers/v4l2/format_agreement.h"
#include "hal/camera.h"

namespace sparsight {

// What a dequeued buffer says, copied into `frame`, whose bytes are reused. A raw frame always has
// the bytes that its format needs: those that did not come are zero, and the frame is damaged.
void frame_of_buffer(const v4l2_buffer& buffer, std::span<const std::uint8_t> memory,
                     const AgreedFormat& format, HostTime arrival, CameraFrame& frame);

}  // namespace sparsight
