#include "tools/map/keyframe_file.h"

#include <fmt/format.h>

#include <utility>

#include "tools/map/keyframe_record.h"

namespace sparsight {

Result<KeyframeFile> KeyframeFile::create(const std::filesystem::path& path,
                                          std::uint64_t most_bytes) {
  auto output = create_output_file(path, ExistingFile::kReplace);
  if (!output) return tl::unexpected(output.error());
  return KeyframeFile(path, std::move(*output), most_bytes);
}

Result<KeyframeFile> KeyframeFile::open(const std::filesystem::path& path) {
  auto input = open_input_file(path);
  if (!input) return tl::unexpected(input.error());
  KeyframeFile file(path, nullptr, 0);
  file.input_ = std::move(*input);
  file.end_ = file.input_->size();
  return file;
}

KeyframeFile::KeyframeFile(std::filesystem::path path, std::unique_ptr<OutputFile> output,
                           std::uint64_t most_bytes)
    : path_(std::move(path)), output_(std::move(output)), most_bytes_(most_bytes) {}

std::optional<KeyframePlace> KeyframeFile::append(const KeyframeBulk& bulk) {
  if (!output_) return std::nullopt;
  const std::vector<std::uint8_t> record = keyframe_record(bulk);
  if (record.size() > most_bytes_ - end_) {
    message_ = fmt::format("{}: has reached its bound of {} MB", path_.string(), most_bytes_ >> 20);
    return std::nullopt;
  }
  if (const std::error_code error = output_->write(record)) {
    message_ = fmt::format("{}: {}", path_.string(), error.message());
    // If not even that is possible, nothing may follow the half of a record.
    if (output_->truncate(end_)) output_.reset();
    return std::nullopt;
  }
  const KeyframePlace place{end_, static_cast<std::uint32_t>(record.size())};
  end_ += record.size();
  return place;
}

Result<KeyframeBulk> KeyframeFile::read(const KeyframePlace& place) {
  const std::string source = fmt::format("{}: at byte {}", path_.string(), place.offset);
  if (place.offset > end_ || place.bytes > end_ - place.offset) {
    return fail(ErrorCode::kWrongSize, source + ": the file ends before; it was cut off");
  }
  if (!input_ || input_->size() < place.offset + place.bytes) {  // it has grown
    auto input = open_input_file(path_);
    if (!input) return tl::unexpected(input.error());
    input_ = std::move(*input);
  }
  std::vector<std::uint8_t> record(place.bytes);
  if (!input_->read(place.offset, record)) {
    return fail(ErrorCode::kUnreadable, source + ": the disk refuses to read");
  }
  return parse_keyframe_record(record, source);
}

Result<void> KeyframeFile::sync() {
  if (!output_) return {};
  if (const std::error_code error = output_->sync()) {
    return fail(ErrorCode::kUnreadable, fmt::format("{}: cannot be written to the disk: {}",
                                                    path_.string(), error.message()));
  }
  return {};
}

}  // namespace sparsight
