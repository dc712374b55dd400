#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/datasets/image_file.h"
#include "hal/camera.h"
#include "hal/result.h"

namespace sparsight {

struct JpegExtent {
  int width = 0;
  int height = 0;
  std::size_t bytes = 0;  // to the end of the image, without what the driver put behind it
};

// What the markers of a JPEG say, gone through from its begin to its end: nothing if one is missing
// or out of its order. A decoder alone would fill what is missing with grey and say nothing.
std::optional<JpegExtent> jpeg_extent(std::span<const std::uint8_t> bytes);

// The image of a frame of format kMjpeg. Refused unless its markers are whole and it has the size
// that was agreed with the camera: that is known before anything of this size is reserved.
Result<DecodedImage> decode_jpeg_frame(const CameraFrame& frame);

}  // namespace sparsight
