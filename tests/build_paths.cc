#include "tests/build_paths.h"

#include <cstdlib>

namespace sparsight::testing {

std::filesystem::path source_dir() { return SPARSIGHT_SOURCE_DIR; }

std::filesystem::path build_dir() { return SPARSIGHT_BUILD_DIR; }

std::filesystem::path program() { return SPARSIGHT_PROGRAM; }

std::filesystem::path recordings() {
  const char* folder = std::getenv("SPARSIGHT_DATA");
  return folder != nullptr ? std::filesystem::path(folder)
                           : source_dir() / ".." / "shared" / "data";
}

}  // namespace sparsight::testing
