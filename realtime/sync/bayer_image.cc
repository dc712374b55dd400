#include "realtime/sync/bayer_image.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace sparsight {
namespace {

// Where red stands in each square of two by two pixels; blue stands across.
struct RedAt {
  int u;
  int v;
};

RedAt red_at(PixelFormat format) {
  switch (format) {
    case PixelFormat::kBayerGrbg8:
      return {1, 0};
    case PixelFormat::kBayerGbrg8:
      return {0, 1};
    case PixelFormat::kBayerBggr8:
      return {1, 1};
    default:
      return {0, 0};
  }
}

// Mirrored at the border pixel, so that a neighbour keeps its colour.
int mirrored(int i, int size) {
  if (i < 0) return -i;
  return i < size ? i : 2 * size - 2 - i;
}

struct Rows {
  const std::uint8_t* above;
  const std::uint8_t* here;
  const std::uint8_t* below;
};

using Rgb = std::array<std::uint8_t, 3>;

std::uint8_t mean(unsigned a, unsigned b) { return static_cast<std::uint8_t>((a + b + 1) / 2); }
std::uint8_t mean(unsigned a, unsigned b, unsigned c, unsigned d) {
  return static_cast<std::uint8_t>((a + b + c + d + 2) / 4);
}

Rgb color_at(const Rows& rows, int left, int u, int right, bool red_row, bool red_column) {
  const std::uint8_t own = rows.here[u];
  if (red_row == red_column) {  // a red or a blue pixel
    const std::uint8_t green =
        mean(rows.above[u], rows.below[u], rows.here[left], rows.here[right]);
    const std::uint8_t across =
        mean(rows.above[left], rows.above[right], rows.below[left], rows.below[right]);
    return red_row ? Rgb{own, green, across} : Rgb{across, green, own};
  }
  const std::uint8_t along_row = mean(rows.here[left], rows.here[right]);
  const std::uint8_t along_column = mean(rows.above[u], rows.below[u]);
  return red_row ? Rgb{along_row, own, along_column} : Rgb{along_column, own, along_row};
}

}  // namespace

ConvertedImage from_bayer(const CameraFrame& frame, bool with_color) {
  const RedAt red = red_at(frame.format);
  ConvertedImage image = black_image(frame.width, frame.height, with_color);
  std::uint8_t* grey = image.grey.pixels.data();
  std::uint8_t* rgb = with_color ? image.color->rgb.data() : nullptr;
  const auto row_at = [&](int v) {
    return frame.bytes.data() +
           static_cast<std::ptrdiff_t>(mirrored(v, frame.height)) * frame.stride_bytes;
  };
  for (int v = 0; v < frame.height; ++v) {
    const Rows rows{row_at(v - 1), row_at(v), row_at(v + 1)};
    for (int u = 0; u < frame.width; ++u) {
      const Rgb c = color_at(rows, mirrored(u - 1, frame.width), u, mirrored(u + 1, frame.width),
                             (v & 1) == red.v, (u & 1) == red.u);
      *grey++ = luma_of(c[0], c[1], c[2]);
      if (rgb == nullptr) continue;
      *rgb++ = c[0];
      *rgb++ = c[1];
      *rgb++ = c[2];
    }
  }
  return image;
}

}  // namespace sparsight
