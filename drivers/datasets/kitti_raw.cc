#include "drivers/datasets/kitti_raw.h"

#include <fmt/format.h>

#include <algorithm>

#include "drivers/datasets/calibration_text.h"
#include "drivers/datasets/file_bytes.h"
#include "drivers/datasets/frame_times.h"
#include "drivers/datasets/image_folder.h"

namespace sparsight {
namespace fs = std::filesystem;
namespace {

using Timestamps = std::vector<std::optional<HostTime>>;

Result<CalibrationText> read_text(const fs::path& file) {
  return read_file_bytes(file).and_then(
      [&](const std::string& bytes) { return CalibrationText::parse(bytes, file.string()); });
}

Result<RigCalibration> read_calibration(const fs::path& folder, int camera) {
  const auto cameras = read_text(folder / "calib_cam_to_cam.txt");
  if (!cameras) return tl::unexpected(cameras.error());
  const auto lidar = read_text(folder / "calib_velo_to_cam.txt");
  if (!lidar) return tl::unexpected(lidar.error());
  const auto projection = rectified_camera(*cameras, fmt::format("P_rect_{:02}", camera));
  if (!projection) return tl::unexpected(projection.error());
  const auto R_rect = cameras->rotation("R_rect_00");
  if (!R_rect) return tl::unexpected(R_rect.error());
  const auto R = lidar->rotation("R");
  if (!R) return tl::unexpected(R.error());
  const auto t = lidar->numbers("T", 3);
  if (!t) return tl::unexpected(t.error());
  Eigen::Isometry3d T_camera_0_lidar = Eigen::Isometry3d::Identity();
  T_camera_0_lidar.linear() = *R;
  T_camera_0_lidar.translation() = Eigen::Map<const Eigen::Vector3d>(t->data());
  return RigCalibration{projection->intrinsics,
                        projection->T_camera_reference * *R_rect * T_camera_0_lidar};
}

Result<Timestamps> read_timestamps(const fs::path& file) {
  return read_file_bytes(file).and_then(
      [&](const std::string& bytes) { return parse_timestamps_utc(bytes, file.string()); });
}

Result<std::vector<HostTime>> read_exposures(const fs::path& file) {
  const auto stamps = read_timestamps(file);
  if (!stamps) return tl::unexpected(stamps.error());
  std::vector<HostTime> times;
  for (const auto& stamp : *stamps) {
    if (!stamp) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}:{}: empty line; every image has an exposure time", file.string(),
                              times.size() + 1));
    }
    times.push_back(*stamp);
  }
  return require_increasing(std::move(times), file.string());
}

}  // namespace

bool is_kitti_raw(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder / "velodyne_points", error) ||
         fs::is_directory(folder / "image_00", error);
}

Result<FolderIndex> index_kitti_raw(const fs::path& folder, std::optional<int> camera) {
  const auto images = find_image_folder(folder, "image_0", "data", camera);
  if (!images) return tl::unexpected(images.error());
  auto calibration = read_calibration(folder / "..", images->camera);
  if (!calibration) return tl::unexpected(calibration.error());
  const auto intrinsics = with_image_size(calibration->camera, *images);
  if (!intrinsics) return tl::unexpected(intrinsics.error());
  calibration->camera = *intrinsics;

  const fs::path times_file = images->folder / ".." / "timestamps.txt";
  const auto times = read_exposures(times_file);
  if (!times) return tl::unexpected(times.error());
  const auto starts = read_timestamps(folder / "velodyne_points" / "timestamps_start.txt");
  if (!starts) return tl::unexpected(starts.error());
  const auto ends = read_timestamps(folder / "velodyne_points" / "timestamps_end.txt");
  if (!ends) return tl::unexpected(ends.error());

  const fs::path scan_folder = folder / "velodyne_points" / "data";
  const auto scans = list_numbered_files(scan_folder, {".bin"});
  const std::uint64_t count =
      std::min<std::uint64_t>(images->images.rbegin()->first + 1, times->size());
  FolderIndex index{*calibration, {}, false};
  for (std::uint64_t i = 0; i < count; ++i) {
    FolderFrame frame{(*times)[i], numbered_file(images->images, images->folder, i, ".png"),
                      numbered_file(scans, scan_folder, i, ".bin"), std::nullopt};
    if (i < starts->size() && i < ends->size() && (*starts)[i] && (*ends)[i]) {
      frame.sweep = SweepTiming{*(*starts)[i], *(*ends)[i]};
    }
    index.frames.push_back(std::move(frame));
  }
  return index;
}

}  // namespace sparsight
