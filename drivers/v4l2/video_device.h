#pragma once

#include <linux/videodev2.h>

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include "drivers/v4l2/system_calls.h"
#include "hal/result.h"

namespace sparsight {

// An open video node, closed when it goes out of scope.
class VideoDevice {
 public:
  // Fails, too, if the node does not stream, or has not this ability: V4L2_CAP_VIDEO_CAPTURE or
  // V4L2_CAP_VIDEO_OUTPUT.
  static Result<VideoDevice> open(SystemCalls& calls, const std::string& path,
                                  std::uint32_t ability = V4L2_CAP_VIDEO_CAPTURE);
  ~VideoDevice();
  VideoDevice(VideoDevice&& other) noexcept;
  VideoDevice(const VideoDevice&) = delete;
  VideoDevice& operator=(const VideoDevice&) = delete;
  VideoDevice& operator=(VideoDevice&&) = delete;

  // 0, or a negative errno.
  template <typename Argument>
  int call(unsigned long request, Argument& argument) {
    return calls_.ioctl(fd_, request, &argument);
  }
  int poll(short events, std::chrono::nanoseconds patience) {
    return calls_.poll(fd_, events, patience);
  }
  void* map(std::size_t length, std::uint32_t offset) { return calls_.map(fd_, length, offset); }
  void unmap(void* address, std::size_t length) { calls_.unmap(address, length); }

  const std::string& path() const { return path_; }
  // "PATH: what: the system's reason"
  Error error(std::string_view what, int negative_errno) const;

 private:
  VideoDevice(SystemCalls& calls, std::string path, int fd)
      : calls_(calls), path_(std::move(path)), fd_(fd) {}

  SystemCalls& calls_;
  std::string path_;
  int fd_;
};

}  // namespace sparsight
