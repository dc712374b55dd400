#pragma once

#include <string>
#include <vector>

#include "tests/layering/source_tree.h"

namespace sparsight::layering {

// A broken rule, as a person is told: the file, the line, and what to do instead.
using Violation = std::string;

// hal <- drivers, hal <- slam <- realtime <- tools; nothing upward, nothing sideways.
std::vector<Violation> check_layers(const std::vector<SourceFile>& sources);

// Each third-party library stays in the layers that own it, and the heavy ones out of headers.
std::vector<Violation> check_third_party(const std::vector<SourceFile>& sources);

// Estimation has no thread, no clock and no file of its own.
std::vector<Violation> check_estimation_is_pure(const std::vector<SourceFile>& sources);

// A concept is a file pair; folders are named after concepts.
std::vector<Violation> check_file_pairs(const std::vector<SourceFile>& sources);
std::vector<Violation> check_folder_names(const std::vector<SourceFile>& sources);

}  // namespace sparsight::layering
