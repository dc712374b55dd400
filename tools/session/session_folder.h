#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hal/result.h"

namespace sparsight {

// The last folder of a source's path, whatever the way it is written.
std::string source_name(const std::filesystem::path& source);

// The folder a session of `source` goes to: `output` if given, else ./session-NAME[-RAYSrays],
// numbered so that it is new. Makes it if it is not there. An earlier session (a folder with a
// session.json) given as `output` is replaced, file by file as the new ones are whole; any other
// folder that is not empty is refused.
Result<std::filesystem::path> claim_session_folder(
    const std::optional<std::filesystem::path>& output, const std::filesystem::path& source,
    std::optional<int> rays);

}  // namespace sparsight
