#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "hal/frame_source.h"
#include "hal/rig_event.h"
#include "realtime/sync/synchronizer.h"

namespace sparsight {

// The frames of a rig's raw events: what runs on a data set runs on a recording and on the
// simulated rig.
class RigFrameSource final : public FrameSource {
 public:
  // frame_count: where the source knows how many frames will come out.
  RigFrameSource(std::unique_ptr<RigEventSource> events, std::unique_ptr<LidarDecoder> decoder,
                 const RigCalibration& calibration, const SyncConfig& config, JpegDecoder jpeg = {},
                 std::optional<std::size_t> frame_count = std::nullopt);

  const RigCalibration& calibration() const override { return calibration_; }
  std::optional<std::size_t> frame_count() const override { return frame_count_; }
  std::optional<SynchronizedFrame> next() override;
  // The same with its stamp.
  std::optional<BundledFrame> next_bundled();
  SyncState sync_state() const { return synchronizer_.state(); }

 private:
  std::unique_ptr<RigEventSource> events_;
  RigCalibration calibration_;
  Synchronizer synchronizer_;
  std::optional<std::size_t> frame_count_;
  bool ended_ = false;
};

}  // namespace sparsight
