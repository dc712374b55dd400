#include "tools/map/map_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "drivers/recording/input_file.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = "keyframes-";
constexpr const char* kEnding = ".bin";

tl::unexpected<Error> unreadable(const fs::path& path, std::string_view what,
                                 const std::error_code& error) {
  return fail(ErrorCode::kUnreadable,
              fmt::format("{}: {}: {}", path.string(), what, error.message()));
}

std::error_code last_error() { return {errno, std::generic_category()}; }

bool is_keyframe_file(const fs::path& path) {
  const std::string name = path.filename();
  return name.starts_with(kPrefix) && name.ends_with(kEnding);
}

// What was renamed or linked there is so after a power cut.
Result<void> sync_folder(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return unreadable(folder, "cannot be opened", last_error());
  const int failed = ::fsync(descriptor);
  const std::error_code error = last_error();
  ::close(descriptor);
  if (failed != 0) return unreadable(folder, "cannot be written to the disk", error);
  return {};
}

Result<void> sync_file(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return unreadable(file, "cannot be opened", last_error());
  const int failed = ::fsync(descriptor);
  const std::error_code error = last_error();
  ::close(descriptor);
  if (failed != 0) return unreadable(file, "cannot be written to the disk", error);
  return {};
}

Result<std::vector<std::uint8_t>> bytes_of(const fs::path& path) {
  auto file = open_input_file(path);
  if (!file) return tl::unexpected(file.error());
  std::vector<std::uint8_t> bytes((*file)->size());
  if (!(*file)->read(0, bytes)) {
    return fail(ErrorCode::kUnreadable, path.string() + ": the disk refuses to read");
  }
  return bytes;
}

}  // namespace

bool holds_map(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / kMapIndexFile, error);
}

Result<OpenedMap> open_map(const fs::path& folder) {
  const fs::path path = folder / kMapIndexFile;
  if (!holds_map(folder)) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: holds no map ({} is not there); --save-map makes one",
                            folder.string(), kMapIndexFile));
  }
  const auto bytes = bytes_of(path);
  if (!bytes) return tl::unexpected(bytes.error());
  auto index = parse_map_index(*bytes, path.string());
  if (!index) return tl::unexpected(index.error());
  OpenedMap map{.index = std::move(*index)};
  for (const MapIndex::File& named : map.index.files) {
    auto file = KeyframeFile::open(folder / named.name);
    if (!file) return tl::unexpected(file.error());
    if (file->bytes() < named.bytes) {
      return fail(ErrorCode::kWrongSize,
                  fmt::format("{}: has {} bytes, and the map needs {}; it was cut off",
                              (folder / named.name).string(), file->bytes(), named.bytes));
    }
    map.files.push_back(std::move(*file));
  }
  return map;
}

MapWriter::MapWriter(fs::path folder, int lock) : folder_(std::move(folder)), lock_(lock) {}

MapWriter::MapWriter(MapWriter&& other) noexcept
    : folder_(std::move(other.folder_)), lock_(std::exchange(other.lock_, -1)) {}

MapWriter& MapWriter::operator=(MapWriter&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(lock_, other.lock_);
  return *this;
}

MapWriter::~MapWriter() {
  if (lock_ >= 0) ::close(lock_);
}

Result<MapWriter> MapWriter::claim(const fs::path& folder, bool continues) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return unreadable(folder, "cannot make this folder", error);
  const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock < 0) return unreadable(folder, "cannot be opened", last_error());
  MapWriter writer(folder, lock);
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: another session is saving its map there", folder.string()));
  }
  if (!continues && holds_map(folder)) {
    return fail(ErrorCode::kUnreadable,
                fmt::format("{}: holds a map, which is not overwritten; go on with it by --map {}, "
                            "or give --save-map another folder",
                            folder.string(), folder.string()));
  }
  return writer;
}

fs::path MapWriter::unused_name() const {
  for (int number = 1;; ++number) {
    fs::path path = folder_ / fmt::format("{}{:04}{}", kPrefix, number, kEnding);
    std::error_code error;
    if (!fs::exists(path, error)) return path;
  }
}

Result<KeyframeFile> MapWriter::new_keyframe_file() { return KeyframeFile::create(unused_name()); }

Result<MapIndex::File> MapWriter::adopt(const fs::path& file, std::uint64_t bytes) {
  const fs::path path = unused_name();
  std::error_code error;
  fs::create_hard_link(file, path, error);
  if (error) {
    error.clear();
    fs::copy_file(file, path, error);
  }
  if (error) return unreadable(path, "cannot be written", error);
  if (auto synced = sync_file(path); !synced) return tl::unexpected(synced.error());
  return MapIndex::File{path.filename(), bytes};
}

Result<void> MapWriter::commit(const MapIndex& index) {
  const fs::path partial = folder_ / fmt::format("{}.partial", kMapIndexFile);
  {
    auto file = create_output_file(partial, ExistingFile::kReplace);
    if (!file) return tl::unexpected(file.error());
    std::error_code error = (*file)->write(map_index_bytes(index));
    if (!error) error = (*file)->sync();
    if (error) return unreadable(partial, "cannot be written", error);
  }
  // The new files' names first, then the one that makes them the map.
  if (auto synced = sync_folder(folder_); !synced) return synced;
  std::error_code error;
  fs::rename(partial, folder_ / kMapIndexFile, error);
  if (error) return unreadable(partial, "cannot be renamed", error);
  if (auto synced = sync_folder(folder_); !synced) return synced;
  remove_unused(index);
  return {};
}

void MapWriter::remove_unused(const MapIndex& index) const {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder_, error)) {
    const bool used = std::ranges::any_of(index.files, [&](const MapIndex::File& file) {
      return entry.path().filename() == file.name;
    });
    if (!used && is_keyframe_file(entry.path())) fs::remove(entry.path(), error);
  }
}

}  // namespace sparsight
