#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>

#include "drivers/recording/bytes.h"
#include "hal/result.h"

namespace sparsight {

// The system calls a recording is written with; tests put a disk that is full, slow or gone in
// their place. Thread-bound. An empty error code is success.
class OutputFile {
 public:
  virtual ~OutputFile() = default;
  virtual std::error_code write(Bytes bytes) = 0;  // all of them at the end, or the error
  virtual std::error_code sync() = 0;              // returns when they are on the disk
  virtual std::error_code truncate(std::uint64_t size) = 0;
  virtual std::optional<std::uint64_t> free_bytes() const = 0;  // nothing if it cannot be told
};

enum class ExistingFile : std::uint8_t { kRefuse, kReplace };

// A new file, its name already safe on the disk.
Result<std::unique_ptr<OutputFile>> create_output_file(const std::filesystem::path& path,
                                                       ExistingFile existing);

}  // namespace sparsight
