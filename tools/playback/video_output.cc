#include "tools/playback/video_output.h"

#include <fmt/format.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <cerrno>
#include <chrono>

#include "drivers/v4l2/pixel_format_code.h"

namespace sparsight {
namespace {

constexpr std::uint32_t kBuffers = 8;

v4l2_buffer output_buffer(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  buffer.field = V4L2_FIELD_NONE;
  return buffer;
}

timeval timeval_of(HostTime time) {
  const auto since = time.time_since_epoch();
  const auto seconds = std::chrono::floor<std::chrono::seconds>(since);
  return {seconds.count(),
          std::chrono::duration_cast<std::chrono::microseconds>(since - seconds).count()};
}

// Row by row, as the driver's rows may be longer than the recording's.
std::size_t copy_rows(const CameraFrame& frame, int stride, std::span<std::uint8_t> out) {
  if (frame.stride_bytes == stride || frame.stride_bytes == 0) {
    const std::size_t bytes = std::min(frame.bytes.size(), out.size());
    std::copy_n(frame.bytes.begin(), bytes, out.begin());
    return bytes;
  }
  const auto from = static_cast<std::size_t>(frame.stride_bytes);
  const auto to = static_cast<std::size_t>(stride);
  const std::size_t rows = std::min(frame.bytes.size() / from, out.size() / to);
  for (std::size_t row = 0; row < rows; ++row) {
    std::copy_n(frame.bytes.data() + row * from, std::min(from, to), out.data() + row * to);
  }
  return rows * to;
}

}  // namespace

Result<std::unique_ptr<VideoOutput>> VideoOutput::open(const std::string& path,
                                                       const CameraFrame& like,
                                                       SystemCalls& calls) {
  auto device = VideoDevice::open(calls, path, V4L2_CAP_VIDEO_OUTPUT);
  if (!device) return tl::unexpected(device.error());
  std::unique_ptr<VideoOutput> output(new VideoOutput(std::move(*device), like));
  if (const auto set = output->set_format(); !set) return tl::unexpected(set.error());
  if (const auto mapped = output->map_buffers(); !mapped) return tl::unexpected(mapped.error());
  int type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  if (const int status = output->device_.call(VIDIOC_STREAMON, type); status < 0) {
    return tl::unexpected(output->device_.error("cannot start streaming", status));
  }
  return output;
}

VideoOutput::VideoOutput(VideoDevice device, const CameraFrame& like)
    : device_(std::move(device)), like_(like) {
  like_.bytes.clear();
}

VideoOutput::~VideoOutput() {
  int type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  device_.call(VIDIOC_STREAMOFF, type);
  for (const Mapped& buffer : buffers_) device_.unmap(buffer.memory.data(), buffer.memory.size());
}

Result<void> VideoOutput::set_format() {
  v4l2_format request{};
  request.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  v4l2_pix_format& pixels = request.fmt.pix;
  pixels.width = static_cast<std::uint32_t>(like_.width);
  pixels.height = static_cast<std::uint32_t>(like_.height);
  pixels.pixelformat = code_of(like_.format).fourcc;
  pixels.field = V4L2_FIELD_NONE;
  if (const int status = device_.call(VIDIOC_S_FMT, request); status < 0) {
    return tl::unexpected(device_.error("cannot set the format", status));
  }
  if (pixels.width != static_cast<std::uint32_t>(like_.width) ||
      pixels.height != static_cast<std::uint32_t>(like_.height) ||
      pixels.pixelformat != code_of(like_.format).fourcc) {
    return fail(ErrorCode::kWrongSize,
                fmt::format("{}: does not take {} {}x{}, which the recording holds", device_.path(),
                            code_of(like_.format).name, like_.width, like_.height));
  }
  stride_bytes_ = pixels.bytesperline == 0 ? row_bytes(like_.format, like_.width)
                                           : static_cast<int>(pixels.bytesperline);
  return {};
}

Result<void> VideoOutput::map_buffers() {
  v4l2_requestbuffers request{};
  request.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  request.memory = V4L2_MEMORY_MMAP;
  request.count = kBuffers;
  if (const int status = device_.call(VIDIOC_REQBUFS, request); status < 0) {
    return tl::unexpected(device_.error("cannot get buffers", status));
  }
  for (std::uint32_t index = 0; index < std::min(request.count, kBuffers); ++index) {
    v4l2_buffer buffer = output_buffer(index);
    if (const int status = device_.call(VIDIOC_QUERYBUF, buffer); status < 0) {
      return tl::unexpected(device_.error("cannot query a buffer", status));
    }
    void* memory = device_.map(buffer.length, buffer.m.offset);
    if (!memory) return tl::unexpected(device_.error("cannot map a buffer", -ENOMEM));
    buffers_.push_back({buffer.m.offset, {static_cast<std::uint8_t*>(memory), buffer.length}});
  }
  return {};
}

// Its index, or a negative errno.
int VideoOutput::free_buffer() {
  if (used_ < buffers_.size()) return static_cast<int>(used_++);
  v4l2_buffer buffer = output_buffer(0);
  if (const int status = device_.call(VIDIOC_DQBUF, buffer); status < 0) return status;
  return buffer.index < buffers_.size() ? static_cast<int>(buffer.index) : -EPROTO;
}

// v4l2loopback counts modulo the buffers of the reader, who comes later and may want fewer: which
// memory an index means is asked each time. Empty if it is none that was mapped.
std::span<std::uint8_t> VideoOutput::memory_of(std::uint32_t index) {
  v4l2_buffer buffer = output_buffer(index);
  if (device_.call(VIDIOC_QUERYBUF, buffer) < 0) return {};
  const auto mapped = std::ranges::find(buffers_, buffer.m.offset, &Mapped::offset);
  return mapped == buffers_.end() ? std::span<std::uint8_t>() : mapped->memory;
}

int VideoOutput::write(const CameraFrame& frame, HostTime stamp) {
  if (frame.format != like_.format || frame.width != like_.width || frame.height != like_.height) {
    return -EINVAL;
  }
  const int index = free_buffer();
  if (index < 0) return index;
  v4l2_buffer buffer = output_buffer(static_cast<std::uint32_t>(index));
  const auto memory = memory_of(buffer.index);
  if (memory.empty()) return -EPROTO;
  buffer.bytesused = static_cast<std::uint32_t>(copy_rows(frame, stride_bytes_, memory));
  buffer.timestamp = timeval_of(stamp);
  return device_.call(VIDIOC_QBUF, buffer);
}

}  // namespace sparsight
