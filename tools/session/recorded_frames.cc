#include "tools/session/recorded_frames.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "drivers/datasets/rings.h"
#include "drivers/recording/recording_source.h"
#include "drivers/recording/recording_writer.h"
#include "drivers/vlp16/vlp16_decoder.h"
#include "drivers/vlp16/vlp16_geometry.h"
#include "realtime/sync/rig_frame_source.h"
#include "tools/configuration/rig_file.h"
#include "tools/session/frame_decoder.h"

namespace sparsight {
namespace {

// A recording's frames, as the live rig would have had them.
class RecordedFrames final : public FrameSource {
 public:
  RecordedFrames(std::unique_ptr<RecordingSource> recording, const RigConfig& rig,
                 std::optional<int> rays)
      : recording_(*recording),
        frames_(std::move(recording), std::make_unique<Vlp16Decoder>(rig.lidar), rig.calibration,
                sync_config(rig), frame_decoder(), frames_in(recording_.info())),
        rays_(rays) {}

  const RigCalibration& calibration() const override { return frames_.calibration(); }
  std::optional<std::size_t> frame_count() const override { return frames_.frame_count(); }
  std::optional<SynchronizedFrame> next() override {
    std::optional<SynchronizedFrame> frame = frames_.next();
    if (frame && rays_) {
      keep_rings(frame->sweep.returns, kVlp16Lasers, static_cast<std::size_t>(*rays_));
    }
    return frame;
  }

  std::vector<std::string> remarks() const {
    std::vector<std::string> result;
    if (recording_.info().truncated) {
      result.push_back("the recording was cut off; what follows its last whole chunk is not there");
    }
    const RecordingFaults faults = recording_.faults();
    if (faults.refused_messages > 0) {
      result.push_back(fmt::format("{} damaged messages were left out", faults.refused_messages));
    }
    const SyncState sync = frames_.sync_state();
    const std::uint64_t recorded = frames_in(recording_.info()).value_or(0);
    if (recorded > sync.frames_out) {
      result.push_back(fmt::format(
          "{} of {} frames have no known exposure (no edge was matched to them) and were left out",
          recorded - sync.frames_out, recorded));
    }
    if (sync.frames_without_image > 0) {
      result.push_back(fmt::format("{} frames could not be read", sync.frames_without_image));
    }
    if (sync.packets.lost > 0) {
      result.push_back(fmt::format("{} LiDAR packets are missing", sync.packets.lost));
    }
    return result;
  }

 private:
  static std::optional<std::size_t> frames_in(const RecordingInfo& info) {
    const auto topic = info.messages.find("/camera/frame_info");
    if (topic == info.messages.end()) return std::nullopt;
    return static_cast<std::size_t>(topic->second);
  }

  RecordingSource& recording_;  // owned by frames_
  RigFrameSource frames_;
  std::optional<int> rays_;
};

}  // namespace

Result<OpenedSource> open_recording(const std::filesystem::path& file,
                                    const SourceOptions& options) {
  auto recording = RecordingSource::open(file);
  if (!recording) return tl::unexpected(recording.error());
  const auto description = (*recording)->attachment(kRigConfigurationAttachment);
  if (!description) return tl::unexpected(description.error());
  const auto rig = parse_rig(*description, file.string() + "#rig.toml");
  if (!rig) return tl::unexpected(rig.error());
  if (rig->calibration.camera.width == 0) {
    return fail(ErrorCode::kMissingField,
                fmt::format("{}: its rig.toml has no [calibration.camera]; calibrate the rig and "
                            "record again",
                            file.string()));
  }
  auto frames = std::make_unique<RecordedFrames>(std::move(*recording), *rig, options.rays);
  auto remarks = [source = frames.get()] { return source->remarks(); };
  return OpenedSource{std::move(frames), std::move(remarks)};
}

}  // namespace sparsight
