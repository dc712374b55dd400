#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hal/result.h"
#include "slam/odometry.h"

namespace sparsight {

// Names of the profiles the program carries: the files of config/, without their extension.
std::vector<std::string> built_in_profiles();

// A built-in profile by its name, else the file of that path.
Result<OdometryConfig> load_profile(const std::string& name_or_path);

// `file` only names the text in errors, each on a line: "FILE:LINE: [table] key = value: fix".
// A key that is not given keeps the default of its header.
Result<OdometryConfig> parse_profile(std::string_view toml, std::string_view file);

// All fields with their values; parse_profile() gives the same configuration back.
std::string describe_profile(const OdometryConfig& config);

}  // namespace sparsight
