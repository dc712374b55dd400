#pragma once

#include <filesystem>

// Where this tree and its build lie. Told to build_paths.cc alone, so that all clones of the tree
// share what the compiler has made of every other test.
namespace sparsight::testing {

std::filesystem::path source_dir();
std::filesystem::path build_dir();
std::filesystem::path program();  // the built `sparsight`

// Real recordings are not part of the tree (SPARSIGHT_DATA says where they are); tests that need
// them are skipped where they are absent.
std::filesystem::path recordings();

}  // namespace sparsight::testing
