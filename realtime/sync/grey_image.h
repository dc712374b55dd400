#pragma once

#include <functional>
#include <optional>

#include "hal/camera.h"
#include "hal/image.h"
#include "hal/result.h"

namespace sparsight {

struct ConvertedImage {
  GreyImage grey;
  std::optional<ColorImage> color;  // of formats that have it, where asked for
};

ConvertedImage black_image(int width, int height, bool with_color);

// Compressed frames are read by whoever has a decoder for them.
using JpegDecoder = std::function<Result<ConvertedImage>(const CameraFrame&)>;

// The image that a frame's bytes mean. Sizes are checked before anything is read or reserved.
Result<ConvertedImage> convert_image(const CameraFrame& frame, bool with_color,
                                     const JpegDecoder& jpeg);

}  // namespace sparsight
