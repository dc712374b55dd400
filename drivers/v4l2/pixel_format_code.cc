#include "drivers/v4l2/pixel_format_code.h"

#include <linux/videodev2.h>

#include <algorithm>
#include <array>

namespace sparsight {
namespace {

constexpr std::array<PixelFormatCode, 13> kCodes{{
    {PixelFormat::kGrey8, V4L2_PIX_FMT_GREY, "GREY"},
    {PixelFormat::kGrey10, V4L2_PIX_FMT_Y10, "Y10"},
    {PixelFormat::kGrey12, V4L2_PIX_FMT_Y12, "Y12"},
    {PixelFormat::kGrey16, V4L2_PIX_FMT_Y16, "Y16"},
    {PixelFormat::kBayerRggb8, V4L2_PIX_FMT_SRGGB8, "RGGB"},
    {PixelFormat::kBayerGrbg8, V4L2_PIX_FMT_SGRBG8, "GRBG"},
    {PixelFormat::kBayerGbrg8, V4L2_PIX_FMT_SGBRG8, "GBRG"},
    {PixelFormat::kBayerBggr8, V4L2_PIX_FMT_SBGGR8, "BA81"},
    {PixelFormat::kYuyv, V4L2_PIX_FMT_YUYV, "YUYV"},
    {PixelFormat::kUyvy, V4L2_PIX_FMT_UYVY, "UYVY"},
    {PixelFormat::kNv12, V4L2_PIX_FMT_NV12, "NV12"},
    {PixelFormat::kRgb8, V4L2_PIX_FMT_RGB24, "RGB3"},
    {PixelFormat::kMjpeg, V4L2_PIX_FMT_MJPEG, "MJPG"},
}};

}  // namespace

std::span<const PixelFormatCode> pixel_format_codes() { return kCodes; }

const PixelFormatCode& code_of(PixelFormat format) {
  return kCodes[static_cast<std::size_t>(format)];
}

std::optional<PixelFormat> format_of(std::uint32_t fourcc) {
  for (const PixelFormatCode& code : kCodes) {
    if (code.fourcc == fourcc) return code.format;
  }
  return std::nullopt;
}

std::optional<PixelFormat> format_named(std::string_view name) {
  for (const PixelFormatCode& code : kCodes) {
    if (code.name == name) return code.format;
  }
  return std::nullopt;
}

int row_bytes(PixelFormat format, int width) {
  switch (format) {
    case PixelFormat::kGrey10:
    case PixelFormat::kGrey12:
    case PixelFormat::kGrey16:
    case PixelFormat::kYuyv:
    case PixelFormat::kUyvy:
      return 2 * width;
    case PixelFormat::kRgb8:
      return 3 * width;
    case PixelFormat::kMjpeg:
      return 0;
    default:
      return width;
  }
}

std::size_t frame_bytes(PixelFormat format, int stride_bytes, int height) {
  if (format == PixelFormat::kMjpeg) return 1;
  const auto plane = static_cast<std::size_t>(stride_bytes) * static_cast<std::size_t>(height);
  return format == PixelFormat::kNv12 ? plane + plane / 2 : plane;
}

}  // namespace sparsight
