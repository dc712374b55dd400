#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "drivers/v4l2/system_calls.h"
#include "drivers/v4l2/video_stream.h"
#include "hal/camera.h"
#include "hal/rig_config.h"

namespace sparsight {

// A camera behind the kernel's V4L2 interface. Each read() takes every frame that waits out of the
// driver's few buffers, copies it and gives the buffer back at once, so that frames which nobody
// reads for a while wait here (about a second of them) and not in the driver. Whatever goes wrong
// with a running stream ends it and starts it anew under a new epoch, from the path.
class V4l2Camera final : public Camera {
 public:
  explicit V4l2Camera(CameraConfig config, SystemCalls& calls = linux_calls());
  ~V4l2Camera() override;

  Result<void> start() override;
  std::optional<CameraFrame> read(std::chrono::nanoseconds patience) override;
  void stop() override;
  DeviceState state() const override { return state_; }
  std::filesystem::path system_folder() const override;
  CameraCounters counters() const override { return counters_; }

  // The memory of a frame that is no longer needed, for one to come. Thread-safe.
  void recycle(std::vector<std::uint8_t> bytes);

  // What was agreed at the last start of the stream.
  const AgreedFormat& format() const { return format_; }
  std::chrono::nanoseconds exposure() const { return exposure_; }
  // Why the last stream ended or could not be started; "" if none did.
  const std::string& last_fault() const { return last_fault_; }

 private:
  void advance(std::chrono::nanoseconds patience);
  void look_for_device(std::chrono::nanoseconds patience);
  void take_frames();
  void take(const v4l2_buffer& buffer);
  void count_sequence(std::uint32_t sequence);
  void end_stream(std::string_view what, int negative_errno);
  Result<void> begin_stream();
  void note_silence();
  std::vector<std::uint8_t> spare_bytes();

  CameraConfig config_;
  SystemCalls& calls_;
  std::unique_ptr<VideoStream> stream_;
  AgreedFormat format_;
  std::chrono::nanoseconds exposure_{0};
  DeviceState state_ = DeviceState::kStopped;
  CameraCounters counters_;
  std::string last_fault_;
  std::deque<CameraFrame> waiting_;
  std::uint32_t streams_ = 0;                   // begun so far; the epoch is one less
  std::uint32_t epoch_ = 0;                     // of the frame taken last
  std::optional<std::uint32_t> last_sequence_;  // in this epoch
  HostTime last_sign_of_life_;
  HostTime next_attempt_;

  std::mutex spare_mutex_;
  std::vector<std::vector<std::uint8_t>> spare_;
};

}  // namespace sparsight
