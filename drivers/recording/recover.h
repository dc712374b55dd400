#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>

#include "drivers/recording/mcap_reader.h"
#include "hal/result.h"

namespace sparsight {

struct RecoveryReport {
  bool was_whole = false;  // closed and indexed: there was nothing to recover
  std::uint64_t messages = 0;
  std::uint64_t attachments = 0;
  std::chrono::nanoseconds duration{0};
  std::uint64_t bytes_read = 0;
  std::uint64_t bytes_written = 0;
  McapFaults faults;
};

// Writes everything that can still be read of a recording that was cut off or damaged (or of any
// MCAP file) to a new, whole and indexed one. The damaged file is left as it is; `output` must not
// exist, and appears only when it is complete.
Result<RecoveryReport> recover_recording(const std::filesystem::path& damaged,
                                         const std::filesystem::path& output);

}  // namespace sparsight
