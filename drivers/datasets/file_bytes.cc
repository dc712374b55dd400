#include "drivers/datasets/file_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <optional>

namespace sparsight {
namespace fs = std::filesystem;
namespace {

// Far above any scan or image; a device file or a mistaken path must not fill the memory.
constexpr std::uintmax_t kMaxFileBytes = 512ULL << 20;

std::optional<std::uint64_t> number_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  if (error != std::errc() || end != stem.data() + stem.size()) return std::nullopt;
  return number;
}

}  // namespace

Result<std::string> read_file_bytes(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: no such file", file.string()));
  }
  if (!fs::is_regular_file(file, error)) {
    return fail(ErrorCode::kUnreadable, fmt::format("{}: not a regular file", file.string()));
  }
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) {
    return fail(ErrorCode::kUnreadable, fmt::format("{}: {}", file.string(), error.message()));
  }
  if (size > kMaxFileBytes) {
    return fail(ErrorCode::kOutOfRange, fmt::format("{}: {} bytes; at most {} are read",
                                                    file.string(), size, kMaxFileBytes));
  }
  std::string bytes(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  if (!stream || !stream.read(bytes.data(), static_cast<std::streamsize>(size))) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: cannot be read; check its permissions", file.string()));
  }
  return bytes;
}

std::map<std::uint64_t, fs::path> list_numbered_files(const fs::path& folder,
                                                      const std::vector<std::string>& extensions) {
  std::map<std::uint64_t, fs::path> files;
  const auto rank = [&](const fs::path& file) {
    return std::find(extensions.begin(), extensions.end(), file.extension().string()) -
           extensions.begin();
  };
  const auto wanted = static_cast<std::ptrdiff_t>(extensions.size());
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& file = entry->path();
    const std::optional<std::uint64_t> number = number_of(file);
    if (!number || rank(file) == wanted) continue;
    const auto [known, inserted] = files.try_emplace(*number, file);
    if (!inserted && rank(file) < rank(known->second)) known->second = file;
  }
  return files;
}

}  // namespace sparsight
