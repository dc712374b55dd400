#include "drivers/datasets/kitti_odometry.h"

#include <fmt/format.h>

#include <algorithm>

#include "drivers/datasets/calibration_text.h"
#include "drivers/datasets/file_bytes.h"
#include "drivers/datasets/frame_times.h"
#include "drivers/datasets/image_folder.h"

namespace sparsight {
namespace fs = std::filesystem;
namespace {

Result<RigCalibration> read_calibration(const fs::path& file, int camera) {
  const auto text = read_file_bytes(file).and_then(
      [&](const std::string& bytes) { return CalibrationText::parse(bytes, file.string()); });
  if (!text) return tl::unexpected(text.error());
  const auto projection = rectified_camera(*text, fmt::format("P{}", camera));
  if (!projection) return tl::unexpected(projection.error());
  const auto T_reference_lidar = text->transform("Tr");
  if (!T_reference_lidar) return tl::unexpected(T_reference_lidar.error());
  return RigCalibration{projection->intrinsics,
                        projection->T_camera_reference * *T_reference_lidar};
}

Result<std::vector<HostTime>> read_times(const fs::path& file) {
  return read_file_bytes(file)
      .and_then([&](const std::string& bytes) { return parse_times_seconds(bytes, file.string()); })
      .and_then([&](std::vector<HostTime> times) {
        return require_increasing(std::move(times), file.string());
      });
}

}  // namespace

bool is_kitti_odometry(const fs::path& folder) {
  std::error_code error;
  return fs::exists(folder / "calib.txt", error) || fs::exists(folder / "times.txt", error) ||
         fs::is_directory(folder / "velodyne", error);
}

Result<FolderIndex> index_kitti_odometry(const fs::path& folder, std::optional<int> camera) {
  const auto images = find_image_folder(folder, "image_", "", camera);
  if (!images) return tl::unexpected(images.error());
  auto calibration = read_calibration(folder / "calib.txt", images->camera);
  if (!calibration) return tl::unexpected(calibration.error());
  const auto intrinsics = with_image_size(calibration->camera, *images);
  if (!intrinsics) return tl::unexpected(intrinsics.error());
  calibration->camera = *intrinsics;

  const auto times = read_times(folder / "times.txt");
  if (!times) return tl::unexpected(times.error());
  const std::uint64_t last_image = images->images.rbegin()->first;
  if (last_image >= times->size()) {
    return fail(ErrorCode::kWrongSize,
                fmt::format("{}: {} lines, but {} needs line {}; one time per image is needed",
                            (folder / "times.txt").string(), times->size(),
                            images->images.rbegin()->second.string(), last_image + 1));
  }
  const auto scans = list_numbered_files(folder / "velodyne", {".bin"});
  // A last image that is missing still has its scan and its time.
  const std::uint64_t last_scan = scans.empty() ? 0 : scans.rbegin()->first;
  const std::uint64_t count =
      std::min<std::uint64_t>(std::max(last_image, last_scan) + 1, times->size());
  FolderIndex index{*calibration, {}, true};
  for (std::uint64_t i = 0; i < count; ++i) {
    index.frames.push_back({(*times)[i], numbered_file(images->images, images->folder, i, ".png"),
                            numbered_file(scans, folder / "velodyne", i, ".bin"), std::nullopt});
  }
  return index;
}

}  // namespace sparsight
