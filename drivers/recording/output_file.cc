#include "drivers/recording/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace sparsight {
namespace {

std::error_code last_error() { return {errno, std::generic_category()}; }

class SystemFile final : public OutputFile {
 public:
  explicit SystemFile(int descriptor) : descriptor_(descriptor) {}
  ~SystemFile() override { ::close(descriptor_); }
  SystemFile(const SystemFile&) = delete;
  SystemFile& operator=(const SystemFile&) = delete;

  std::error_code write(Bytes bytes) override {
    while (!bytes.empty()) {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return last_error();
      bytes = bytes.subspan(static_cast<std::size_t>(count));
    }
    return {};
  }

  std::error_code sync() override {
    return ::fdatasync(descriptor_) == 0 ? std::error_code() : last_error();
  }

  std::error_code truncate(std::uint64_t size) override {
    const auto end = static_cast<off_t>(size);
    if (::ftruncate(descriptor_, end) != 0 || ::lseek(descriptor_, end, SEEK_SET) < 0) {
      return last_error();
    }
    return {};
  }

  std::optional<std::uint64_t> free_bytes() const override {
    struct statvfs status {};
    if (::fstatvfs(descriptor_, &status) != 0) return std::nullopt;
    return std::uint64_t{status.f_bavail} * status.f_frsize;
  }

 private:
  const int descriptor_;
};

// A power cut must not take the name of a file whose bytes are safe.
void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

Result<std::unique_ptr<OutputFile>> create_output_file(const std::filesystem::path& path,
                                                       ExistingFile existing) {
  const int replace = existing == ExistingFile::kReplace ? O_TRUNC : O_EXCL;
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | replace, 0644);
  if (descriptor < 0) {
    const int error = errno;
    const char* fix = error == EEXIST ? "choose another name; a recording is never overwritten"
                                      : "check the folder, its permissions and the disk";
    return fail(error == ENOENT ? ErrorCode::kNotFound : ErrorCode::kUnreadable,
                fmt::format("{}: cannot be created: {}; {}", path.string(),
                            std::generic_category().message(error), fix));
  }
  auto file = std::make_unique<SystemFile>(descriptor);
  sync_folder(path.parent_path());
  return file;
}

}  // namespace sparsight
