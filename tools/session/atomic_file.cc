#include "tools/session/atomic_file.h"

#include <fmt/format.h>

#include <system_error>

namespace sparsight {

AtomicFile::AtomicFile(std::filesystem::path path, Appears appears)
    : path_(std::move(path)),
      partial_(appears == Appears::kWhole ? path_.string() + ".partial" : path_.string()),
      stream_(partial_, std::ios::binary | std::ios::trunc) {}

Result<void> AtomicFile::commit() {
  stream_.close();
  if (!stream_) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: cannot be written; check the folder's permission and free space",
                            partial_.string()));
  }
  if (partial_ == path_) return {};
  std::error_code error;
  std::filesystem::rename(partial_, path_, error);
  if (error) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: cannot be renamed to {}: {}", partial_.string(),
                            path_.filename().string(), error.message()));
  }
  return {};
}

Result<void> write_file(const std::filesystem::path& path, std::string_view content) {
  AtomicFile file(path);
  file.stream() << content;
  return file.commit();
}

}  // namespace sparsight
