#pragma once

#include <filesystem>

#include "hal/result.h"
#include "tools/session/open_source.h"

namespace sparsight {

// The frames of a folder with a capture, images and their times; see CaptureFolder.
Result<OpenedSource> open_capture(const std::filesystem::path& folder,
                                  const SourceOptions& options);

}  // namespace sparsight
