#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "drivers/v4l2/system_calls.h"
#include "drivers/v4l2/video_device.h"
#include "hal/camera.h"

namespace sparsight {

// A V4L2 output node, such as v4l2loopback's: what is written there comes out of the camera it
// feeds. Streams from its opening until it goes out of scope. Thread-bound.
class VideoOutput {
 public:
  // For frames such as this one: its pixel format and size.
  static Result<std::unique_ptr<VideoOutput>> open(const std::string& path, const CameraFrame& like,
                                                   SystemCalls& calls = linux_calls());
  ~VideoOutput();
  VideoOutput(const VideoOutput&) = delete;
  VideoOutput& operator=(const VideoOutput&) = delete;

  // The frame with this stamp, to the microsecond that V4L2 has. 0, or a negative errno: -EAGAIN
  // if the driver holds all buffers, -EINVAL if the frame is not like the first.
  int write(const CameraFrame& frame, HostTime stamp);

 private:
  VideoOutput(VideoDevice device, const CameraFrame& like);
  Result<void> set_format();
  Result<void> map_buffers();
  int free_buffer();
  std::span<std::uint8_t> memory_of(std::uint32_t index);

  VideoDevice device_;
  CameraFrame like_;  // without its bytes
  int stride_bytes_ = 0;
  struct Mapped {
    std::uint32_t offset;  // by which the driver knows it
    std::span<std::uint8_t> memory;
  };
  std::vector<Mapped> buffers_;
  std::size_t used_ = 0;  // the first so many buffers have been queued before
};

}  // namespace sparsight
