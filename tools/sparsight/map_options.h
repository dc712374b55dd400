#pragma once

#include <CLI/CLI.hpp>
#include <vector>

#include "tools/cloud/cloud_file.h"

namespace sparsight {

// --map-format and --no-map of a command whose session has a map.
void add_map_options(CLI::App& command, std::vector<CloudFormat>& formats);

}  // namespace sparsight
