#pragma once

#include <cstdlib>
#include <filesystem>

namespace sparsight::testing {

// Real recordings are not part of the tree; tests that need them are skipped where they are absent.
inline std::filesystem::path recordings() {
  const char* set = std::getenv("SPARSIGHT_DATA");
  return set != nullptr ? std::filesystem::path(set)
                        : std::filesystem::path(SPARSIGHT_SOURCE_DIR) / ".." / "shared" / "data";
}

}  // namespace sparsight::testing
