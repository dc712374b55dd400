#pragma once

#include <filesystem>
#include <string>

#include "hal/result.h"
#include "tools/benchmark/replay_run.h"

namespace sparsight {

// Runs `PROGRAM replay ... --quiet` as a child process, so that a crash costs one run and memory
// starts afresh. What it prints goes to the run's log; progress is read from the session's journal.
ReplayRunner replay_in_process(const std::filesystem::path& program);

// Tells one build of a program from another: a hash of the file.
Result<std::string> fingerprint(const std::filesystem::path& program);

}  // namespace sparsight
