#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "hal/result.h"
#include "hal/rig_config.h"
#include "tools/doctor/check.h"

namespace sparsight {

// A recording looked at as the rig would have been. `rig` in place of the description in it, where
// given: another calibration tried on it.
Result<std::vector<Check>> examine_recording(const std::filesystem::path& file,
                                             const std::optional<RigConfig>& rig,
                                             const std::filesystem::path& overlay);

}  // namespace sparsight
