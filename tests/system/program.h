#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sparsight {

struct ProgramRun {
  int exit_code = -1;
  std::string output;  // standard output
  std::string errors;  // standard error
};

// Runs the built sparsight with these arguments, as a person would from a shell.
ProgramRun run_sparsight(const std::vector<std::string>& arguments);

// A folder of this test alone, empty.
std::filesystem::path scratch_folder();

std::string text_of(const std::filesystem::path& file);
// Lines that are not comments.
std::size_t pose_count(const std::filesystem::path& file);

}  // namespace sparsight
