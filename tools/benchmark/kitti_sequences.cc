#include "tools/benchmark/kitti_sequences.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace sparsight {
namespace {

namespace fs = std::filesystem;

bool is_folder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::vector<std::string> folder_names(const fs::path& parent) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_folder(entry->path())) names.push_back(entry->path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::size_t count_images(const fs::path& folder) {
  std::size_t count = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    count += entry->path().extension() == ".png" ? 1 : 0;
  }
  return count;
}

// Of the lowest camera, which is the one replay tracks.
std::size_t count_images_of_lowest_camera(const fs::path& sequence) {
  for (int camera = 0; camera < 4; ++camera) {
    const fs::path images = sequence / fmt::format("image_{}", camera);
    if (is_folder(images)) return count_images(images);
  }
  return 0;
}

std::string what_is_missing(const KittiSequence& sequence) {
  if (!is_folder(sequence.folder)) return "no such folder";
  if (sequence.images == 0) return "no PNG images in image_0 ... image_3";
  return is_folder(sequence.folder / "velodyne") ? "" : "no folder velodyne";
}

Result<fs::path> layout_root(const fs::path& root) {
  for (const fs::path& candidate : {root, root / "dataset"}) {
    if (is_folder(candidate / "sequences")) return candidate;
  }
  return fail(
      ErrorCode::kNotFound,
      fmt::format("{}: holds no folder sequences; give the folder of the KITTI odometry data "
                  "set that holds sequences/ and poses/",
                  root.string()));
}

}  // namespace

Result<KittiSequences> find_kitti_sequences(const fs::path& root,
                                            const std::vector<std::string>& wanted) {
  const Result<fs::path> layout = layout_root(root);
  if (!layout) return tl::unexpected(layout.error());
  KittiSequences sequences;
  for (const std::string& name : wanted.empty() ? folder_names(*layout / "sequences") : wanted) {
    KittiSequence sequence{.name = name, .folder = *layout / "sequences" / name};
    sequence.images = count_images_of_lowest_camera(sequence.folder);
    const fs::path truth = *layout / "poses" / (name + ".txt");
    if (is_file(truth) && is_folder(sequence.folder / "image_0")) sequence.truth = truth;
    const std::string missing = what_is_missing(sequence);
    if (missing.empty()) {
      sequences.found.push_back(sequence);
    } else if (wanted.empty()) {
      sequences.notes.push_back(
          fmt::format("{}: {}; passed over", sequence.folder.string(), missing));
    } else {
      return fail(ErrorCode::kNotFound, fmt::format("{}: {}", sequence.folder.string(), missing));
    }
  }
  if (sequences.found.empty()) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: no sequence has both images and scans",
                                                  (*layout / "sequences").string()));
  }
  return sequences;
}

}  // namespace sparsight
