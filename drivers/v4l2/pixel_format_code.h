#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "hal/camera.h"

namespace sparsight {

// A format as the kernel and `v4l2-ctl --list-formats` call it.
struct PixelFormatCode {
  PixelFormat format;
  std::uint32_t fourcc;
  std::string_view name;  // the four characters, without the blanks at their end
};

// All of them, in the order in which a camera is asked for them.
std::span<const PixelFormatCode> pixel_format_codes();

const PixelFormatCode& code_of(PixelFormat format);
std::optional<PixelFormat> format_of(std::uint32_t fourcc);
std::optional<PixelFormat> format_named(std::string_view name);

// Bytes that a row needs at least; 0 for kMjpeg, which has no rows.
int row_bytes(PixelFormat format, int width);
// Bytes that a frame needs at least; 1 for kMjpeg, whose frames end where they end.
std::size_t frame_bytes(PixelFormat format, int stride_bytes, int height);

}  // namespace sparsight
