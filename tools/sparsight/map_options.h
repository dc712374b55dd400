#pragma once

#include <CLI/CLI.hpp>
#include <vector>

#include "tools/cloud/cloud_file.h"
#include "tools/map/session_map.h"

namespace sparsight {

// Of a command whose session has a map: the files it is written to, and the maps it goes on in and
// leaves.
void add_map_options(CLI::App& command, std::vector<CloudFormat>& formats, SessionMapOptions& maps);

}  // namespace sparsight
