#include "tools/session/captured_frames.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "drivers/datasets/capture_events.h"
#include "drivers/datasets/rings.h"
#include "drivers/vlp16/vlp16_decoder.h"
#include "drivers/vlp16/vlp16_geometry.h"
#include "realtime/sync/rig_frame_source.h"
#include "tools/configuration/rig_file.h"

namespace sparsight {
namespace {

// Times that somebody wrote down are taken for what they say.
SyncConfig sync_of_known_times(const RigConfig& rig) {
  SyncConfig config = sync_config(rig);
  config.exposure_source = ExposureSource::kDriverTime;
  config.driver_time_sigma = std::chrono::milliseconds(1);
  return config;
}

class CapturedFrames final : public FrameSource {
 public:
  CapturedFrames(std::unique_ptr<CaptureEvents> events, const RigConfig& rig, std::size_t count,
                 CaptureClock clock, std::optional<int> rays)
      : events_(*events),
        frames_(std::move(events), std::make_unique<Vlp16Decoder>(rig.lidar), rig.calibration,
                sync_of_known_times(rig), {}, count),
        clock_(clock),
        rays_(rays) {}

  const RigCalibration& calibration() const override { return frames_.calibration(); }
  std::optional<std::size_t> frame_count() const override { return frames_.frame_count(); }
  std::optional<SynchronizedFrame> next() override {
    std::optional<BundledFrame> bundled = frames_.next_bundled();
    if (!bundled) return std::nullopt;
    SynchronizedFrame frame = std::move(bundled->frame);
    // Why an image cannot be read, the file says better than "damaged".
    const auto fault = events_.image_faults().find(bundled->camera_sequence);
    if (fault != events_.image_faults().end() && !frame.faults.empty()) {
      frame.faults.front() = fault->second;
    }
    if (rays_) keep_rings(frame.sweep.returns, kVlp16Lasers, static_cast<std::size_t>(*rays_));
    return frame;
  }

  std::vector<std::string> remarks() const {
    std::vector<std::string> result;
    const CaptureSummary& capture = events_.summary();
    if (!capture.damage.empty()) {
      result.push_back(fmt::format("the capture ends in the middle: {}", capture.damage));
    }
    if (clock_ == CaptureClock::kLidar && capture.positions == 0) {
      result.push_back(
          "no position packets were captured: whether the LiDAR's clock was set by PPS is unknown");
    }
    const SyncState sync = frames_.sync_state();
    if (sync.frames_without_returns > 0) {
      result.push_back(fmt::format("{} of {} images have no LiDAR returns around their exposure",
                                   sync.frames_without_returns, sync.frames_out));
    }
    if (sync.packets.lost > 0) {
      result.push_back(fmt::format("{} LiDAR packets are missing", sync.packets.lost));
    }
    if (sync.packets.refused > 0) {
      result.push_back(fmt::format("{} packets are none of a VLP-16", sync.packets.refused));
    }
    return result;
  }

 private:
  CaptureEvents& events_;  // owned by frames_
  RigFrameSource frames_;
  CaptureClock clock_;
  std::optional<int> rays_;
};

}  // namespace

Result<OpenedSource> open_capture(const std::filesystem::path& folder,
                                  const SourceOptions& options) {
  auto index = index_capture_folder(folder);
  if (!index) return tl::unexpected(index.error());
  const auto rig = load_rig(index->rig.string());
  if (!rig) return tl::unexpected(rig.error());
  if (rig->calibration.camera.width == 0) {
    return fail(ErrorCode::kMissingField,
                fmt::format("{}: has no [calibration.camera]; without it no return can be put into "
                            "an image",
                            index->rig.string()));
  }
  const std::size_t count = index->images.size();
  const CaptureClock clock = index->clock;
  const CaptureOptions capture{.packet_delay = LidarClockConfig{}.packet_delay};
  auto events =
      CaptureEvents::open(std::move(*index), rig->lidar, rig->calibration.camera, capture);
  if (!events) return tl::unexpected(events.error());
  auto frames =
      std::make_unique<CapturedFrames>(std::move(*events), *rig, count, clock, options.rays);
  auto remarks = [source = frames.get()] { return source->remarks(); };
  return OpenedSource{std::move(frames), std::move(remarks)};
}

}  // namespace sparsight
