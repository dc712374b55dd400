#include "realtime/sync/yuv_image.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace sparsight {
namespace {

// Where the bytes of a row's pixels stand.
struct Row {
  const std::uint8_t* luma;
  const std::uint8_t* chroma;  // Cb; Cr stands `cr` bytes after it
  int luma_step;               // bytes from pixel to pixel
  int chroma_step;             // bytes from pair to pair of pixels
  int cr;
};

Row row_at(const CameraFrame& frame, int v) {
  const auto stride = static_cast<std::ptrdiff_t>(frame.stride_bytes);
  const std::uint8_t* row = frame.bytes.data() + v * stride;
  if (frame.format == PixelFormat::kYuyv) return {row, row + 1, 2, 4, 2};
  if (frame.format == PixelFormat::kUyvy) return {row + 1, row, 2, 4, 2};
  return {row, frame.bytes.data() + (frame.height + v / 2) * stride, 1, 2, 1};
}

std::uint8_t clipped(int value) { return static_cast<std::uint8_t>(std::clamp(value, 0, 255)); }

// The matrix of BT.601 in 1/256.
std::uint8_t* put_color(std::uint8_t* rgb, int luma, int cb, int cr) {
  const int c = 298 * (luma - 16) + 128;
  const int d = cb - 128;
  const int e = cr - 128;
  *rgb++ = clipped((c + 409 * e) >> 8);
  *rgb++ = clipped((c - 100 * d - 208 * e) >> 8);
  *rgb++ = clipped((c + 516 * d) >> 8);
  return rgb;
}

}  // namespace

ConvertedImage from_yuv(const CameraFrame& frame, bool with_color) {
  ConvertedImage image = black_image(frame.width, frame.height, with_color);
  std::uint8_t* grey = image.grey.pixels.data();
  std::uint8_t* rgb = with_color ? image.color->rgb.data() : nullptr;
  for (int v = 0; v < frame.height; ++v) {
    const Row row = row_at(frame, v);
    for (int u = 0; u < frame.width; ++u) *grey++ = row.luma[row.luma_step * u];
    if (rgb == nullptr) continue;
    for (int u = 0; u < frame.width; ++u) {
      const std::uint8_t* chroma =
          row.chroma + static_cast<std::ptrdiff_t>(u / 2) * row.chroma_step;
      rgb = put_color(rgb, row.luma[row.luma_step * u], chroma[0], chroma[row.cr]);
    }
  }
  return image;
}

}  // namespace sparsight
