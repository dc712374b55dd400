#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "hal/result.h"

namespace sparsight {

// The whole file, or why not. Never throws on a file the system refuses.
Result<std::string> read_file_bytes(const std::filesystem::path& file);

// The files of a folder whose stem is a whole number, by that number. Where two share a number, the
// extension named first wins. A folder that is not there has no files.
std::map<std::uint64_t, std::filesystem::path> list_numbered_files(
    const std::filesystem::path& folder, const std::vector<std::string>& extensions);

}  // namespace sparsight
