#include "drivers/datasets/kitti_odometry.h"

#include <fmt/format.h>

#include "drivers/datasets/calibration_text.h"
#include "drivers/datasets/file_bytes.h"
#include "drivers/datasets/frame_times.h"
#include "drivers/datasets/image_folder.h"

namespace sparsight {
namespace fs = std::filesystem;
namespace {

Result<RigCalibration> read_calibration(const fs::path& file, const ImageFolder& images) {
  const auto text = read_file_bytes(file).and_then(
      [&](const std::string& bytes) { return CalibrationText::parse(bytes, file.string()); });
  if (!text) return tl::unexpected(text.error());
  const auto projection = rectified_camera(*text, fmt::format("P{}", images.camera));
  if (!projection) return tl::unexpected(projection.error());
  if (!text->has("Tr")) {
    // The archive of the grey images holds a calib.txt without it.
    return fail(ErrorCode::kMissingField,
                fmt::format("{}: field Tr (LiDAR to camera 0, 12 numbers) is missing; use the "
                            "calib.txt of data_odometry_calib.zip",
                            file.string()));
  }
  const auto T_reference_lidar = text->transform("Tr");
  if (!T_reference_lidar) return tl::unexpected(T_reference_lidar.error());
  const auto size = image_size(images);
  if (!size) return tl::unexpected(size.error());
  const auto intrinsics = with_image_size(projection->intrinsics, *size, file.string());
  if (!intrinsics) return tl::unexpected(intrinsics.error());
  return RigCalibration{*intrinsics, projection->T_camera_reference * *T_reference_lidar};
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
  const auto calibration = read_calibration(folder / "calib.txt", *images);
  if (!calibration) return tl::unexpected(calibration.error());
  const auto times = read_times(folder / "times.txt");
  if (!times) return tl::unexpected(times.error());
  const auto scans = list_numbered_files(folder / "velodyne", {".bin"});
  if (scans.empty()) {
    return fail(ErrorCode::kNotFound,
                fmt::format("{}: no scans; looked for velodyne/NNNNNN.bin", folder.string()));
  }
  const auto count = frames_with_times(*images, scans, times->size(), folder / "times.txt");
  if (!count) return tl::unexpected(count.error());
  FolderIndex index{*calibration, {}, true};
  for (std::size_t i = 0; i < *count; ++i) {
    index.frames.push_back({(*times)[i],
                            numbered_file(images->images, images->folder, i, ".png"),
                            numbered_file(scans, folder / "velodyne", i, ".bin"),
                            std::nullopt,
                            {}});
  }
  return index;
}

}  // namespace sparsight
