#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "hal/result.h"
#include "tools/benchmark/replay_run.h"

namespace sparsight {

// Runs `PROGRAM replay ... --quiet` as a child process, so that a crash costs one run and memory
// starts afresh. What it prints goes to the run's log; progress is read from the session's journal.
// A Ctrl-C reaches the child as well, and a second signal would end it without its last files; so
// an interruption is passed on only if the child has not ended after `own_end`.
ReplayRunner replay_in_process(const std::filesystem::path& program,
                               std::chrono::milliseconds own_end = std::chrono::seconds(5));

// Tells one build of a program from another: a hash of the file.
Result<std::string> fingerprint(const std::filesystem::path& program);

}  // namespace sparsight
