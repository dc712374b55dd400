#include <cstddef>
#include <cstdint>

#include "drivers/v4l2/jpeg_frame.h"

// Any bytes that a camera calls a JPEG are an image of the agreed size, or refused.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  sparsight::CameraFrame frame;
  frame.format = sparsight::PixelFormat::kMjpeg;
  frame.width = 32;
  frame.height = 16;
  frame.bytes.assign(data, data + size);
  const auto extent = sparsight::jpeg_extent(frame.bytes);
  if (extent && extent->bytes > size) __builtin_trap();
  const auto image = sparsight::decode_jpeg_frame(frame);
  if (!image) return 0;
  if (!extent || image->grey.pixels.size() != 32U * 16U) __builtin_trap();
  return 0;
}
