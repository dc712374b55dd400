#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "hal/result.h"

namespace sparsight {

Result<std::string> read_text_file(const std::filesystem::path& file);

// The file appears whole or not at all: written beside its place, then renamed.
Result<void> write_text_file(const std::filesystem::path& file, std::string_view text);

}  // namespace sparsight
