#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "drivers/recording/input_file.h"
#include "drivers/recording/output_file.h"
#include "hal/result.h"
#include "slam/map/keyframe_store.h"

namespace sparsight {

// Where a record stands in its file.
struct KeyframePlace {
  std::uint64_t offset = 0;
  std::uint32_t bytes = 0;
};

// Keyframe records (keyframe_record.h), one after the other: written once, at the end, and read
// anywhere. What was written before a power cut is still whole. Thread-bound.
class KeyframeFile {
 public:
  // A new file, in place of any of that name. It grows to no more than `most_bytes`.
  static Result<KeyframeFile> create(const std::filesystem::path& path,
                                     std::uint64_t most_bytes = kMostBytes);
  // To be read only.
  static Result<KeyframeFile> open(const std::filesystem::path& path);
  // For tests: a disk of their own.
  KeyframeFile(std::filesystem::path path, std::unique_ptr<OutputFile> output,
               std::uint64_t most_bytes);

  // Nothing, and the file as before, if the disk or the bound refuses: message() says why.
  std::optional<KeyframePlace> append(const KeyframeBulk& bulk);
  Result<KeyframeBulk> read(const KeyframePlace& place);
  Result<void> sync();

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t bytes() const { return end_; }
  const std::string& message() const { return message_; }

  static constexpr std::uint64_t kMostBytes = std::uint64_t{16} << 30;  // 16 hours

 private:
  std::filesystem::path path_;
  std::unique_ptr<OutputFile> output_;  // none: read only
  std::unique_ptr<InputFile> input_;
  std::uint64_t most_bytes_ = 0;
  std::uint64_t end_ = 0;
  std::string message_;
};

}  // namespace sparsight
