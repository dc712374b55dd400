#include "drivers/datasets/open_dataset.h"

#include <fmt/format.h>

#include "drivers/datasets/kitti_odometry.h"
#include "drivers/datasets/kitti_raw.h"
#include "drivers/datasets/prefetching_source.h"

namespace sparsight {
namespace fs = std::filesystem;
namespace {

// Enough to bridge a keyframe's work while the loader goes on; about 2 MB a frame.
constexpr std::size_t kFramesAhead = 4;

Result<FolderIndex> index_folder(const fs::path& folder, std::optional<int> camera) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: no such folder", folder.string()));
  }
  if (is_kitti_raw(folder)) return index_kitti_raw(folder, camera);
  if (is_kitti_odometry(folder)) return index_kitti_odometry(folder, camera);
  return fail(ErrorCode::kNotFound,
              fmt::format("{}: not a data set. Looked for a KITTI odometry sequence (calib.txt, "
                          "times.txt, image_N/, velodyne/) and a KITTI raw drive (image_0N/, "
                          "velodyne_points/)",
                          folder.string()));
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
