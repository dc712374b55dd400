#include "drivers/recording/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace sparsight {
namespace {

class SystemInput final : public InputFile {
 public:
  SystemInput(int descriptor, std::uint64_t size) : descriptor_(descriptor), size_(size) {}
  ~SystemInput() override { ::close(descriptor_); }
  SystemInput(const SystemInput&) = delete;
  SystemInput& operator=(const SystemInput&) = delete;

  std::uint64_t size() const override { return size_; }

  bool read(std::uint64_t offset, std::span<std::uint8_t> out) override {
    if (offset > size_ || out.size() > size_ - offset) return false;
    while (!out.empty()) {
      const ssize_t count =
          ::pread(descriptor_, out.data(), out.size(), static_cast<off_t>(offset));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      offset += static_cast<std::uint64_t>(count);
      out = out.subspan(static_cast<std::size_t>(count));
    }
    return true;
  }

 private:
  const int descriptor_;
  const std::uint64_t size_;
};

class MemoryInput final : public InputFile {
 public:
  explicit MemoryInput(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}
  std::uint64_t size() const override { return bytes_.size(); }
  bool read(std::uint64_t offset, std::span<std::uint8_t> out) override {
    if (offset > bytes_.size() || out.size() > bytes_.size() - offset) return false;
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), out.size(), out.begin());
    return true;
  }

 private:
  const std::vector<std::uint8_t> bytes_;
};

}  // namespace

Result<std::unique_ptr<InputFile>> open_input_file(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    const int error = errno;
    return fail(error == ENOENT ? ErrorCode::kNotFound : ErrorCode::kUnreadable,
                fmt::format("{}: cannot be opened: {}", path.string(),
                            std::generic_category().message(error)));
  }
  struct stat status {};
  if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode)) {
    ::close(descriptor);
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: not a regular file; a recording ends in .mcap", path.string()));
  }
  return std::make_unique<SystemInput>(descriptor, static_cast<std::uint64_t>(status.st_size));
}

std::unique_ptr<InputFile> input_from_memory(std::vector<std::uint8_t> bytes) {
  return std::make_unique<MemoryInput>(std::move(bytes));
}

}  // namespace sparsight
