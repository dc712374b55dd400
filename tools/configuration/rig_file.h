#pragma once

#include <string>
#include <string_view>

#include "hal/result.h"
#include "hal/rig_config.h"

namespace sparsight {

// The rig that a file describes; config/rig/handheld.toml shows every key.
Result<RigConfig> load_rig(const std::string& path);

// `file` only names the text in errors, each on a line: "FILE:LINE: [table] key = value: fix".
// A key that is not given keeps the default of its header; a rig without [calibration.camera] is
// not calibrated, and has a camera of width 0.
Result<RigConfig> parse_rig(std::string_view toml, std::string_view file);

// All that is set, as TOML; parse_rig() gives an equal rig back, to the last digit.
std::string describe(const RigConfig& rig);

}  // namespace sparsight
