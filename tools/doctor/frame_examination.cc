#include "tools/doctor/frame_examination.h"

#include <utility>

#include "drivers/vlp16/vlp16_decoder.h"
#include "realtime/sync/rig_frame_source.h"
#include "tools/doctor/alignment_checks.h"
#include "tools/doctor/edge_alignment.h"
#include "tools/doctor/overlay_image.h"
#include "tools/doctor/sync_checks.h"
#include "tools/session/frame_decoder.h"

namespace sparsight {

Check examine_alignment(FrameSource& frames, const std::filesystem::path& overlay) {
  EdgeAlignment alignment(frames.calibration());
  while (const auto frame = frames.next()) alignment.add(*frame);
  std::string written;
  if (alignment.best_frame() && !overlay.empty()) {
    const auto wrote =
        write_png(overlay, draw_overlay(*alignment.best_frame(), frames.calibration()));
    written = wrote ? overlay.string() : wrote.error().message;
  }
  return alignment_check(alignment.report(), written);
}

std::vector<Check> examine_events(std::unique_ptr<RigEventSource> events, const RigConfig& rig,
                                  const std::filesystem::path& overlay) {
  RigFrameSource frames(std::move(events), std::make_unique<Vlp16Decoder>(rig.lidar),
                        rig.calibration, sync_config(rig), frame_decoder());
  if (rig.calibration.camera.width == 0) {  // which another check tells
    while (frames.next()) {
    }
    return sync_checks(frames.sync_state());
  }
  Check aligned = examine_alignment(frames, overlay);
  std::vector<Check> checks = sync_checks(frames.sync_state());
  checks.push_back(std::move(aligned));
  return checks;
}

}  // namespace sparsight
