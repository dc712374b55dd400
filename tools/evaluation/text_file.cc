#include "tools/evaluation/text_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
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

}  // namespace sparsight
