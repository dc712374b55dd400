#include "drivers/v4l2/frame_of_buffer.h"

#include <algorithm>
#include <chrono>

#include "drivers/v4l2/pixel_format_code.h"

namespace sparsight {
namespace {

// The driver's stamp where it is on our clock and can be true, else the arrival. Its flag "start of
// exposure" is left alone: uvcvideo sets it on stamps taken later.
HostTime driver_time_of(const v4l2_buffer& buffer, HostTime arrival) {
  if ((buffer.flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) != V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC) {
    return arrival;
  }
  const HostTime stamp(std::chrono::seconds(buffer.timestamp.tv_sec) +
                       std::chrono::microseconds(buffer.timestamp.tv_usec));
  return stamp > HostTime{} && stamp <= arrival ? stamp : arrival;
}

// A JPEG begins with the marker SOI (ITU-T T.81, table B.1).
bool starts_like_jpeg(std::span<const std::uint8_t> bytes) {
  return bytes.size() > 2 && bytes[0] == 0xFF && bytes[1] == 0xD8;
}

}  // namespace

void frame_of_buffer(const v4l2_buffer& buffer, std::span<const std::uint8_t> memory,
                     const AgreedFormat& format, HostTime arrival, CameraFrame& frame) {
  const auto came = memory.first(std::min<std::size_t>(buffer.bytesused, memory.size()));
  const std::size_t needed = frame_bytes(format.format, format.stride_bytes, format.height);
  frame.sequence = buffer.sequence;
  frame.driver_time = driver_time_of(buffer, arrival);
  frame.arrival = arrival;
  frame.damaged = (buffer.flags & V4L2_BUF_FLAG_ERROR) != 0 || came.size() < needed;
  frame.format = format.format;
  frame.width = format.width;
  frame.height = format.height;
  frame.stride_bytes = format.stride_bytes;
  if (format.format == PixelFormat::kMjpeg) {
    frame.bytes.assign(came.begin(), came.end());
    frame.damaged = frame.damaged || !starts_like_jpeg(came);
    return;
  }
  const auto used = came.first(std::min(came.size(), needed));
  frame.bytes.assign(used.begin(), used.end());
  frame.bytes.resize(needed, 0);
}

}  // namespace sparsight
