#include "drivers/datasets/open_dataset.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <vector>

#include "drivers/datasets/capture_folder.h"
#include "drivers/datasets/kitti_odometry.h"
#include "drivers/datasets/kitti_raw.h"
#include "drivers/datasets/prefetching_source.h"

namespace sparsight {
namespace fs = std::filesystem;
namespace {

// Enough to bridge a keyframe's work while the loader goes on; about 2 MB a frame.
constexpr std::size_t kFramesAhead = 4;

bool is_dataset(const fs::path& folder) {
  return is_kitti_raw(folder) || is_kitti_odometry(folder) || is_capture_folder(folder);
}

// Data sets one or two levels below: what a person who named the folder above may have meant.
std::string datasets_below(const fs::path& folder) {
  constexpr std::size_t kMostNamed = 5;
  std::vector<std::string> found;
  std::error_code error;
  fs::recursive_directory_iterator entry(folder, fs::directory_options::skip_permission_denied,
                                         error);
  for (const fs::recursive_directory_iterator end; !error && entry != end; entry.increment(error)) {
    std::error_code unknown;
    if (!entry->is_directory(unknown)) continue;
    const bool dataset = is_dataset(entry->path());
    if (dataset) found.push_back(entry->path().string());
    if (dataset || entry.depth() >= 1) entry.disable_recursion_pending();
  }
  if (found.empty()) return {};
  std::sort(found.begin(), found.end());
  const bool more = found.size() > kMostNamed;
  if (more) found.resize(kMostNamed);
  return fmt::format(". Below it there are: {}{}", fmt::join(found, ", "), more ? ", ..." : "");
}

Result<FolderIndex> index_folder(const fs::path& folder, std::optional<int> camera) {
  std::error_code error;
  if (!fs::exists(folder, error)) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: no such folder", folder.string()));
  }
  if (!fs::is_directory(folder, error)) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: a file; a data set is a folder", folder.string()));
  }
  if (is_kitti_raw(folder)) return index_kitti_raw(folder, camera);
  if (is_kitti_odometry(folder)) return index_kitti_odometry(folder, camera);
  return fail(ErrorCode::kNotFound,
              fmt::format("{}: not a data set. Looked for a KITTI odometry sequence (calib.txt, "
                          "times.txt, image_N/, velodyne/), a KITTI raw drive (image_0N/, "
                          "velodyne_points/) and a capture (lidar.pcap, images/, times.txt, "
                          "rig.toml){}",
                          folder.string(), datasets_below(folder)));
}

}  // namespace

Result<std::unique_ptr<FrameSource>> open_dataset(const fs::path& folder,
                                                  const DatasetOptions& options) {
  if (options.rays && *options.rays < 1) {
    return fail(ErrorCode::kOutOfRange,
                fmt::format("rays: {}; at least 1 is needed", *options.rays));
  }
  auto index = index_folder(folder, options.camera);
  if (!index) return tl::unexpected(std::move(index.error()));
  return std::make_unique<PrefetchingSource>(
      std::make_unique<FolderSource>(std::move(*index), options.rays), kFramesAhead);
}

}  // namespace sparsight
