#include "realtime/sync/rig_frame_source.h"

#include <utility>

namespace sparsight {

RigFrameSource::RigFrameSource(std::unique_ptr<RigEventSource> events,
                               std::unique_ptr<LidarDecoder> decoder,
                               const RigCalibration& calibration, const SyncConfig& config,
                               JpegDecoder jpeg, std::optional<std::size_t> frame_count)
    : events_(std::move(events)),
      calibration_(calibration),
      synchronizer_(calibration, config, std::move(decoder), std::move(jpeg)),
      frame_count_(frame_count) {}

std::optional<BundledFrame> RigFrameSource::next_bundled() {
  while (true) {
    if (auto frame = synchronizer_.take()) return frame;
    if (ended_) return std::nullopt;
    if (const auto event = events_->next()) {
      synchronizer_.add(*event);
    } else {
      ended_ = true;
      synchronizer_.finish();
    }
  }
}

std::optional<SynchronizedFrame> RigFrameSource::next() {
  auto bundled = next_bundled();
  if (!bundled) return std::nullopt;
  return std::move(bundled->frame);
}

}  // namespace sparsight
