#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "hal/frame_source.h"
#include "hal/rig_config.h"
#include "hal/rig_event.h"
#include "tools/doctor/check.h"

namespace sparsight {

// The checks of what becomes of a rig's raw events: synchronisation, and the LiDAR on the image.
// The picture of that is written to `overlay`; "" for none.
std::vector<Check> examine_events(std::unique_ptr<RigEventSource> events, const RigConfig& rig,
                                  const std::filesystem::path& overlay);

// The LiDAR on the image alone, of any source of frames.
Check examine_alignment(FrameSource& frames, const std::filesystem::path& overlay);

}  // namespace sparsight
