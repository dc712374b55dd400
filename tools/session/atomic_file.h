#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "hal/result.h"

namespace sparsight {

// A file that appears under its name only when it is whole: it is written beside it with the ending
// ".partial" and renamed by commit(). Without commit() (a crash) the partial file stays, and an
// older file of that name is as it was.
class AtomicFile {
 public:
  enum class Appears : std::uint8_t {
    kWhole,
    kAtOnce,  // a journal that is worth reading however far it got: under its name from the start
  };
  explicit AtomicFile(std::filesystem::path path, Appears appears = Appears::kWhole);

  std::ostream& stream() { return stream_; }
  // Pushes what was written so far to the system, so that a crash does not lose it.
  void flush() { stream_.flush(); }
  Result<void> commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path partial_;
  std::ofstream stream_;
};

Result<void> write_file(const std::filesystem::path& path, std::string_view content);

}  // namespace sparsight
