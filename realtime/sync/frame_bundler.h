#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "hal/calibration.h"
#include "hal/frame_source.h"
#include "hal/stamp.h"
#include "realtime/sync/edge_matcher.h"
#include "realtime/sync/grey_image.h"
#include "realtime/sync/lidar_buffer.h"
#include "realtime/sync/lidar_clock.h"

namespace sparsight {

struct FrameBundlerConfig {
  bool with_color = true;
  std::chrono::nanoseconds most_lidar_uncertainty{3'000'000};  // with more, no returns are given
};

// A frame as the estimator takes it, and what is known of its times.
struct BundledFrame {
  SynchronizedFrame frame;
  Stamp stamp;
  std::uint32_t camera_epoch = 0;
  std::uint32_t camera_sequence = 0;
  std::optional<std::chrono::nanoseconds> lidar_uncertainty;  // of the firings' times, one sigma
};

// Puts an exposed image and the returns around its exposure together. What cannot be read is left
// out of the frame and named in its faults. Thread-bound.
class FrameBundler {
 public:
  FrameBundler(const CameraIntrinsics& camera, const FrameBundlerConfig& config, JpegDecoder jpeg);

  BundledFrame bundle(const StampedFrame& stamped, const LidarBuffer& returns,
                      const LidarClock& clock);

 private:
  void add_image(const CameraFrame& frame, SynchronizedFrame& out) const;
  void add_returns(const StampedFrame& stamped, const LidarBuffer& returns, const LidarClock& clock,
                   BundledFrame& out) const;

  CameraIntrinsics camera_;
  FrameBundlerConfig config_;
  JpegDecoder jpeg_;
  std::uint64_t next_sequence_ = 0;
};

}  // namespace sparsight
