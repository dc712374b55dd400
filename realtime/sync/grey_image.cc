#include "realtime/sync/grey_image.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "realtime/sync/bayer_image.h"
#include "realtime/sync/yuv_image.h"

namespace sparsight {
namespace {

constexpr int kMostPixels = 16'384;  // along a side

struct Layout {
  std::size_t row_bytes;  // least, of the first plane
  std::size_t rows;       // of the first plane's stride, over all planes
  bool even_width;
  bool even_height;
};

Layout layout_of(const CameraFrame& frame) {
  const auto width = static_cast<std::size_t>(frame.width);
  const auto height = static_cast<std::size_t>(frame.height);
  switch (frame.format) {
    case PixelFormat::kGrey8:
    case PixelFormat::kMjpeg:
      return {width, height, false, false};
    case PixelFormat::kGrey10:
    case PixelFormat::kGrey12:
    case PixelFormat::kGrey16:
      return {2 * width, height, false, false};
    case PixelFormat::kYuyv:
    case PixelFormat::kUyvy:
      return {2 * width, height, true, false};
    case PixelFormat::kRgb8:
      return {3 * width, height, false, false};
    case PixelFormat::kNv12:
      return {width, height + height / 2, true, true};
    case PixelFormat::kBayerRggb8:
    case PixelFormat::kBayerGrbg8:
    case PixelFormat::kBayerGbrg8:
    case PixelFormat::kBayerBggr8:
      return {width, height, true, true};
  }
  return {0, 0, false, false};
}

Result<void> check_size(const CameraFrame& frame) {
  if (frame.width <= 0 || frame.height <= 0 || frame.width > kMostPixels ||
      frame.height > kMostPixels) {
    return fail(ErrorCode::kWrongSize, "camera frame of " + std::to_string(frame.width) + " x " +
                                           std::to_string(frame.height) +
                                           " pixels; 1 to 16384 along a side can be read");
  }
  if (frame.format == PixelFormat::kMjpeg) return {};
  const Layout layout = layout_of(frame);
  if ((layout.even_width && frame.width % 2 != 0) ||
      (layout.even_height && frame.height % 2 != 0)) {
    return fail(ErrorCode::kWrongSize, "camera frame of " + std::to_string(frame.width) + " x " +
                                           std::to_string(frame.height) +
                                           " pixels; its pixel format needs even sides");
  }
  const auto stride = static_cast<std::size_t>(std::max(0, frame.stride_bytes));
  const std::size_t needed = stride * (layout.rows - 1) + layout.row_bytes;
  if (stride < layout.row_bytes || frame.bytes.size() < needed) {
    return fail(ErrorCode::kWrongSize,
                "camera frame with rows of " + std::to_string(frame.stride_bytes) + " bytes and " +
                    std::to_string(frame.bytes.size()) + " in all; its size needs at least " +
                    std::to_string(layout.row_bytes) + " and " + std::to_string(needed));
  }
  return {};
}

GreyImage from_8_bits(const CameraFrame& frame) {
  const auto width = static_cast<std::size_t>(frame.width);
  GreyImage grey{.width = frame.width, .height = frame.height};
  grey.pixels.resize(width * static_cast<std::size_t>(frame.height));
  for (int v = 0; v < frame.height; ++v) {
    const std::uint8_t* row =
        frame.bytes.data() + static_cast<std::ptrdiff_t>(v) * frame.stride_bytes;
    std::copy_n(row, width, grey.pixels.begin() + static_cast<std::ptrdiff_t>(v) * frame.width);
  }
  return grey;
}

// Little-endian words of which the low `bits` count; the upper eight of these are kept.
GreyImage from_16_bits(const CameraFrame& frame, int bits) {
  GreyImage grey{.width = frame.width, .height = frame.height};
  grey.pixels.resize(static_cast<std::size_t>(frame.width) *
                     static_cast<std::size_t>(frame.height));
  const unsigned most = (1U << bits) - 1U;
  std::uint8_t* out = grey.pixels.data();
  for (int v = 0; v < frame.height; ++v) {
    const std::uint8_t* row =
        frame.bytes.data() + static_cast<std::ptrdiff_t>(v) * frame.stride_bytes;
    for (int u = 0; u < frame.width; ++u) {
      const unsigned value = row[2 * u] | static_cast<unsigned>(row[2 * u + 1]) << 8U;
      *out++ = static_cast<std::uint8_t>(std::min(value, most) >> static_cast<unsigned>(bits - 8));
    }
  }
  return grey;
}

ConvertedImage from_rgb(const CameraFrame& frame, bool with_color) {
  ConvertedImage image = black_image(frame.width, frame.height, with_color);
  std::uint8_t* grey = image.grey.pixels.data();
  const auto row_bytes = 3 * static_cast<std::ptrdiff_t>(frame.width);
  for (int v = 0; v < frame.height; ++v) {
    const std::uint8_t* row =
        frame.bytes.data() + static_cast<std::ptrdiff_t>(v) * frame.stride_bytes;
    if (with_color) std::copy_n(row, row_bytes, image.color->rgb.begin() + v * row_bytes);
    for (const std::uint8_t* c = row; c != row + row_bytes; c += 3)
      *grey++ = luma_of(c[0], c[1], c[2]);
  }
  return image;
}

}  // namespace

ConvertedImage black_image(int width, int height, bool with_color) {
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  ConvertedImage image{.grey = {.width = width, .height = height}};
  image.grey.pixels.resize(pixels);
  if (with_color) {
    image.color = ColorImage{.width = width, .height = height};
    image.color->rgb.resize(3 * pixels);
  }
  return image;
}

Result<ConvertedImage> convert_image(const CameraFrame& frame, bool with_color,
                                     const JpegDecoder& jpeg) {
  if (const auto fits = check_size(frame); !fits) return tl::unexpected(fits.error());
  switch (frame.format) {
    case PixelFormat::kGrey8:
      return ConvertedImage{.grey = from_8_bits(frame)};
    case PixelFormat::kGrey10:
      return ConvertedImage{.grey = from_16_bits(frame, 10)};
    case PixelFormat::kGrey12:
      return ConvertedImage{.grey = from_16_bits(frame, 12)};
    case PixelFormat::kGrey16:
      return ConvertedImage{.grey = from_16_bits(frame, 16)};
    case PixelFormat::kBayerRggb8:
    case PixelFormat::kBayerGrbg8:
    case PixelFormat::kBayerGbrg8:
    case PixelFormat::kBayerBggr8:
      return from_bayer(frame, with_color);
    case PixelFormat::kYuyv:
    case PixelFormat::kUyvy:
    case PixelFormat::kNv12:
      return from_yuv(frame, with_color);
    case PixelFormat::kRgb8:
      return from_rgb(frame, with_color);
    case PixelFormat::kMjpeg:
      break;
  }
  if (frame.format == PixelFormat::kMjpeg && jpeg) return jpeg(frame);
  return fail(ErrorCode::kUnreadable,
              "no decoder for the camera's pixel format; choose an uncompressed one in "
              "[camera] format");
}

}  // namespace sparsight
