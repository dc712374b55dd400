#pragma once

#include <filesystem>

#include "hal/result.h"
#include "tools/session/open_source.h"

namespace sparsight {

// The frames of a recording (.mcap), as the live rig would have had them. The rig's description is
// in it.
Result<OpenedSource> open_recording(const std::filesystem::path& file,
                                    const SourceOptions& options);

}  // namespace sparsight
