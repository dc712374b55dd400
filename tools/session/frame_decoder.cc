#include "tools/session/frame_decoder.h"

#include <utility>

#include "drivers/v4l2/jpeg_frame.h"

namespace sparsight {

JpegDecoder frame_decoder() {
  return [](const CameraFrame& frame) {
    return decode_jpeg_frame(frame).map([](DecodedImage&& image) {
      return ConvertedImage{.grey = std::move(image.grey), .color = std::move(image.color)};
    });
  };
}

}  // namespace sparsight
