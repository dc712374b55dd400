#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "drivers/recording/bytes.h"
#include "hal/result.h"

namespace sparsight {

// Bytes that are read anywhere: a file, or memory in its place. Thread-bound.
class InputFile {
 public:
  virtual ~InputFile() = default;
  virtual std::uint64_t size() const = 0;
  // Fills all of `out` from the offset on, or is false: past the end, or the disk refused.
  virtual bool read(std::uint64_t offset, std::span<std::uint8_t> out) = 0;
};

// Read by system calls, not mapped: a disk that goes away is then an error, not a signal.
Result<std::unique_ptr<InputFile>> open_input_file(const std::filesystem::path& path);

std::unique_ptr<InputFile> input_from_memory(std::vector<std::uint8_t> bytes);

}  // namespace sparsight
