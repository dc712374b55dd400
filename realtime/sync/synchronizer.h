#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "hal/lidar.h"
#include "hal/rig_config.h"
#include "hal/rig_event.h"
#include "realtime/sync/edge_matcher.h"
#include "realtime/sync/frame_bundler.h"
#include "realtime/sync/lidar_buffer.h"
#include "realtime/sync/lidar_clock.h"

namespace sparsight {

// What tells when a frame was exposed.
enum class ExposureSource : std::uint8_t {
  kEdges,
  kDriverTime,  // no line is wired, or the source knows: CameraFrame::driver_time is the exposure
};

struct SyncConfig {
  ExposureSource exposure_source = ExposureSource::kEdges;
  std::chrono::nanoseconds driver_time_sigma{5'000'000};
  EdgeMatcherConfig edges;
  LidarClockConfig clock;
  LidarBufferConfig buffer;
  FrameBundlerConfig bundler;
  std::size_t ready_frames = 16;  // not taken yet; beyond that the oldest is dropped
};

// What of the settings follows from the rig's description.
SyncConfig sync_config(const RigConfig& rig);

struct SyncState {
  CameraSyncState camera;
  LidarClockState lidar;
  DecoderCounters packets;
  std::uint64_t events_refused = 0;  // at times that no host has
  std::uint64_t frames_out = 0;
  std::uint64_t frames_without_image = 0;  // damaged, or not to be read
  std::uint64_t frames_without_returns = 0;
  std::uint64_t frames_not_taken = 0;  // dropped, as nobody took them in time
};

// Raw events in the order of arrival to frames with their returns, on one clock. A pure function of
// the events: the same ones give the same frames. Frames whose exposure is not known are counted
// and left out. Bounded memory; thread-bound.
class Synchronizer {
 public:
  Synchronizer(const RigCalibration& calibration, const SyncConfig& config,
               std::unique_ptr<LidarDecoder> decoder, JpegDecoder jpeg = {});

  void add(const RigEvent& event);
  // The events have ended.
  void finish();
  // Frames in the order of their exposure; nothing when the next is not decided yet.
  std::optional<BundledFrame> take();
  SyncState state() const;

 private:
  void handle(const std::shared_ptr<const CameraFrame>& frame);
  void handle(const Edge& edge);
  void handle(const LidarPacket& packet);
  void handle(const PositionPacket& packet);
  void handle(const DeviceStateChange& change);
  void bundle_decided();
  void stamp_by_driver(const std::shared_ptr<const CameraFrame>& frame);

  SyncConfig config_;
  std::unique_ptr<LidarDecoder> decoder_;
  EdgeMatcher matcher_;
  LidarClock clock_;
  LidarBuffer buffer_;
  FrameBundler bundler_;
  DecodedPacket packet_;
  std::vector<StampedFrame> decided_;
  std::optional<HostTime> last_exposure_;
  std::deque<BundledFrame> ready_;
  SyncState counts_;
};

}  // namespace sparsight
