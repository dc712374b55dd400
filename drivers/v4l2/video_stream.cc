#include "drivers/v4l2/video_stream.h"

#include <fmt/format.h>
#include <poll.h>

#include <cerrno>

#include "drivers/v4l2/camera_settings.h"
#include "drivers/v4l2/pixel_format_code.h"

namespace sparsight {
namespace {

v4l2_buffer mapped_buffer(std::uint32_t index) {
  v4l2_buffer buffer{};
  buffer.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  buffer.memory = V4L2_MEMORY_MMAP;
  buffer.index = index;
  return buffer;
}

v4l2_requestbuffers buffer_request(std::uint32_t count) {
  v4l2_requestbuffers request{};
  request.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  request.memory = V4L2_MEMORY_MMAP;
  request.count = count;
  return request;
}

}  // namespace

Result<std::unique_ptr<VideoStream>> VideoStream::start(SystemCalls& calls,
                                                        const CameraConfig& config) {
  auto device = VideoDevice::open(calls, config.device);
  if (!device) return tl::unexpected(device.error());
  std::unique_ptr<VideoStream> stream(new VideoStream(std::move(*device)));
  const auto format = agree_on_format(stream->device_, config);
  if (!format) return tl::unexpected(format.error());
  stream->format_ = *format;
  const auto exposure = apply_settings(stream->device_, config);
  if (!exposure) return tl::unexpected(exposure.error());
  stream->exposure_ = *exposure;
  if (auto mapped = stream->map_buffers(config.buffers); !mapped) {
    return tl::unexpected(mapped.error());
  }
  if (auto on = stream->stream_on(); !on) return tl::unexpected(on.error());
  return stream;
}

VideoStream::~VideoStream() {
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  device_.call(VIDIOC_STREAMOFF, type);
  for (const auto& memory : buffers_) device_.unmap(memory.data(), memory.size());
  v4l2_requestbuffers none = buffer_request(0);
  device_.call(VIDIOC_REQBUFS, none);
}

Result<void> VideoStream::map_buffers(int count) {
  v4l2_requestbuffers request = buffer_request(static_cast<std::uint32_t>(count));
  if (const int status = device_.call(VIDIOC_REQBUFS, request); status < 0) {
    return tl::unexpected(device_.error("cannot get buffers", status));
  }
  if (request.count < 2) {  // the driver fills one while we read the other
    return fail(ErrorCode::kWrongSize,
                fmt::format("{}: has memory for {} buffers only; two are needed: lower [camera] "
                            "width and height",
                            device_.path(), request.count));
  }
  for (std::uint32_t index = 0; index < request.count; ++index) {
    if (auto mapped = map_buffer(index); !mapped) return mapped;
  }
  return {};
}

Result<void> VideoStream::map_buffer(std::uint32_t index) {
  v4l2_buffer buffer = mapped_buffer(index);
  if (const int status = device_.call(VIDIOC_QUERYBUF, buffer); status < 0) {
    return tl::unexpected(device_.error("cannot query a buffer", status));
  }
  const std::size_t needed = frame_bytes(format_.format, format_.stride_bytes, format_.height);
  if (buffer.length < needed) {
    return fail(ErrorCode::kWrongSize,
                fmt::format("{}: its buffers have {} bytes, a frame needs {}; this is the driver's "
                            "fault: try another [camera] format",
                            device_.path(), buffer.length, needed));
  }
  void* memory = device_.map(buffer.length, buffer.m.offset);
  if (!memory) return tl::unexpected(device_.error("cannot map a buffer", -ENOMEM));
  buffers_.emplace_back(static_cast<std::uint8_t*>(memory), buffer.length);
  if (const int status = queue(buffer); status < 0) {
    return tl::unexpected(device_.error("cannot queue a buffer", status));
  }
  return {};
}

Result<void> VideoStream::stream_on() {
  // Few drivers have sources that change; those that have none refuse this.
  v4l2_event_subscription change{};
  change.type = V4L2_EVENT_SOURCE_CHANGE;
  device_.call(VIDIOC_SUBSCRIBE_EVENT, change);
  int type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
  if (const int status = device_.call(VIDIOC_STREAMON, type); status < 0) {
    return tl::unexpected(device_.error("cannot start streaming", status));
  }
  return {};
}

int VideoStream::poll(std::chrono::nanoseconds patience) {
  return device_.poll(POLLIN | POLLPRI, patience);
}

int VideoStream::dequeue(v4l2_buffer& buffer) {
  buffer = mapped_buffer(0);
  const int status = device_.call(VIDIOC_DQBUF, buffer);
  if (status < 0) return status;
  return buffer.index < buffers_.size() ? 0 : -EPROTO;
}

int VideoStream::queue(const v4l2_buffer& buffer) {
  v4l2_buffer empty = mapped_buffer(buffer.index);
  return device_.call(VIDIOC_QBUF, empty);
}

std::span<const std::uint8_t> VideoStream::memory(const v4l2_buffer& buffer) const {
  return buffers_[buffer.index];
}

bool VideoStream::source_changed() {
  bool changed = false;
  v4l2_event event{};
  // As many as the kernel may hold; more is a driver that makes them up.
  for (int i = 0; i < 64 && device_.call(VIDIOC_DQEVENT, event) == 0; ++i) {
    changed = changed || event.type == V4L2_EVENT_SOURCE_CHANGE;
  }
  return changed;
}

}  // namespace sparsight
