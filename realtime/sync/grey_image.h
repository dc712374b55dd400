#pragma once

#include <cstdint>
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

// ITU-R BT.601: 0.299 R + 0.587 G + 0.114 B, in 1/256.
constexpr std::uint8_t luma_of(unsigned red, unsigned green, unsigned blue) {
  return static_cast<std::uint8_t>((77U * red + 150U * green + 29U * blue + 128U) >> 8U);
}

ConvertedImage black_image(int width, int height, bool with_color);

// Compressed frames are read by whoever has a decoder for them.
using JpegDecoder = std::function<Result<ConvertedImage>(const CameraFrame&)>;

// The image that a frame's bytes mean. Sizes are checked before anything is read or reserved.
Result<ConvertedImage> convert_image(const CameraFrame& frame, bool with_color,
                                     const JpegDecoder& jpeg);

}  // namespace sparsight
