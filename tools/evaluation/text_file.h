#pragma once

#include <filesystem>
#include <string>

#include "hal/result.h"

namespace sparsight {

Result<std::string> read_text_file(const std::filesystem::path& file);

}  // namespace sparsight
