#include "tools/evaluation/text_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <system_error>

namespace sparsight {

Result<std::string> read_text_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: no such file", file.string()));
  }
  if (std::filesystem::is_directory(status)) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: is a folder, a file is needed", file.string()));
  }
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  // An empty file inserts nothing, which sets failbit on `text`, not badbit on `stream`.
  if (!stream || !(text << stream.rdbuf(), !stream.bad())) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
  }
  return std::move(text).str();
}

Result<void> write_text_file(const std::filesystem::path& file, std::string_view text) {
  const std::string partial = file.string() + ".partial";
  const auto refuse = [&] {
    const std::string why = std::strerror(errno);
    std::remove(partial.c_str());
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: cannot be written: {}", file.string(), why));
  };
  std::FILE* stream = std::fopen(partial.c_str(), "wb");
  if (stream == nullptr) {
    return refuse();
  }
  const bool written = std::fwrite(text.data(), 1, text.size(), stream) == text.size() &&
                       std::fflush(stream) == 0 && ::fsync(::fileno(stream)) == 0;
  if (std::fclose(stream) != 0 || !written || std::rename(partial.c_str(), file.c_str()) != 0) {
    return refuse();
  }
  return {};
}

}  // namespace sparsight
