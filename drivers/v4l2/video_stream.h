#pragma once

#include <linux/videodev2.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "drivers/v4l2/format_agreement.h"
#include "drivers/v4l2/video_device.h"

namespace sparsight {

// A camera that streams into mapped buffers, from its start-up to its end: when it goes out of
// scope the stream is stopped and the buffers are given back.
class VideoStream {
 public:
  // Opens, agrees on a format, applies the settings, maps the buffers, streams.
  static Result<std::unique_ptr<VideoStream>> start(SystemCalls& calls, const CameraConfig& config);
  ~VideoStream();
  VideoStream(const VideoStream&) = delete;
  VideoStream& operator=(const VideoStream&) = delete;

  const AgreedFormat& format() const { return format_; }
  std::chrono::nanoseconds exposure() const { return exposure_; }
  std::size_t buffers() const { return buffers_.size(); }

  int poll(std::chrono::nanoseconds patience);
  // 0, -EAGAIN when no buffer is full, or what is wrong; an index out of range is -EPROTO.
  int dequeue(v4l2_buffer& buffer);
  int queue(const v4l2_buffer& buffer);
  std::span<const std::uint8_t> memory(const v4l2_buffer& buffer) const;
  // Takes all events that have come; true if the source's format has changed.
  bool source_changed();

 private:
  explicit VideoStream(VideoDevice device) : device_(std::move(device)) {}
  Result<void> map_buffers(int count);
  Result<void> map_buffer(std::uint32_t index);
  Result<void> stream_on();

  VideoDevice device_;
  AgreedFormat format_;
  std::chrono::nanoseconds exposure_{0};
  std::vector<std::span<std::uint8_t>> buffers_;
};

}  // namespace sparsight
