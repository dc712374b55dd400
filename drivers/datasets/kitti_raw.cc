#include "drivers/datasets/kitti_raw.h"

#include <fmt/format.h>

#include "drivers/datasets/file_bytes.h"
#include "drivers/datasets/frame_times.h"
#include "drivers/datasets/image_folder.h"
#include "drivers/datasets/kitti_raw_calibration.h"
#include "drivers/datasets/sweep_folder.h"
#include "drivers/datasets/trigger_time.h"

namespace sparsight {
namespace fs = std::filesystem;
namespace {

Result<std::vector<HostTime>> read_arrivals(const fs::path& file) {
  const auto stamps = read_file_bytes(file).and_then(
      [&](const std::string& bytes) { return parse_timestamps_utc(bytes, file.string()); });
  if (!stamps) return tl::unexpected(stamps.error());
  std::vector<HostTime> times;
  for (const auto& stamp : *stamps) {
    if (!stamp) {
      return fail(ErrorCode::kMalformed,
                  fmt::format("{}:{}: empty line; every image needs its line with a time",
                              file.string(), times.size() + 1));
    }
    times.push_back(*stamp);
  }
  return require_increasing(std::move(times), file.string());
}

// The scan of each image: the one with its number, or in drives that are not synchronised
// (..._extract) the one next in time.
std::vector<std::uint64_t> scan_of_each_image(const fs::path& drive, const SweepFolder& sweeps,
                                              const std::vector<HostTime>& arrivals) {
  const bool unsynchronised =
      fs::absolute(drive).lexically_normal().string().find("_extract") != std::string::npos;
  std::vector<std::uint64_t> scan;
  for (const HostTime arrival : arrivals) {
    const std::uint64_t same_number = scan.size();
    scan.push_back(unsynchronised ? sweeps.nearest(arrival).value_or(UINT64_MAX) : same_number);
  }
  return scan;
}

FolderFrame frame_of(std::size_t number, HostTime exposure, std::uint64_t scan,
                     const ImageFolder& images, const SweepFolder& sweeps) {
  FolderFrame frame;
  frame.exposure = exposure;
  frame.image = numbered_file(images.images, images.folder, number, ".png");
  frame.scan = numbered_file(sweeps.scans, sweeps.folder / "data", scan, ".bin");
  if (!sweeps.scans.contains(scan)) {
    frame.faults.push_back({ErrorCode::kNotFound, fmt::format("{}: no such file; the frame has no "
                                                              "depth of its own",
                                                              frame.scan.string())});
    return frame;
  }
  auto timing = sweeps.timing(scan, exposure);
  if (timing) {
    frame.sweep = *timing;
  } else {
    frame.faults.push_back(std::move(timing.error()));
  }
  return frame;
}

}  // namespace

bool is_kitti_raw(const fs::path& folder) {
  std::error_code error;
  return fs::is_directory(folder / "velodyne_points", error) ||
         fs::is_directory(folder / "image_00", error) ||
         fs::is_directory(folder / "image_02", error);
}

Result<FolderIndex> index_kitti_raw(const fs::path& folder, std::optional<int> camera) {
  const auto images = find_image_folder(folder, "image_0", "data", camera);
  if (!images) return tl::unexpected(images.error());
  const auto calibration = read_kitti_raw_calibration(folder, *images);
  if (!calibration) return tl::unexpected(calibration.error());
  const fs::path times_file = images->folder.parent_path() / "timestamps.txt";
  const auto arrivals = read_arrivals(times_file);
  if (!arrivals) return tl::unexpected(arrivals.error());
  const auto sweeps = read_sweep_folder(folder / "velodyne_points");
  if (!sweeps) return tl::unexpected(sweeps.error());
  const auto count = frames_with_times(*images, sweeps->scans, arrivals->size(), times_file);
  if (!count) return tl::unexpected(count.error());

  const std::vector<std::uint64_t> scan = scan_of_each_image(folder, *sweeps, *arrivals);
  std::vector<std::optional<HostTime>> triggers;
  triggers.reserve(scan.size());
  for (const std::uint64_t number : scan) triggers.push_back(sweeps->trigger(number));
  const auto exposures =
      require_increasing(exposure_times(*arrivals, triggers), times_file.string());
  if (!exposures) return tl::unexpected(exposures.error());
  FolderIndex index{*calibration, {}, false};
  for (std::size_t i = 0; i < *count; ++i) {
    index.frames.push_back(frame_of(i, (*exposures)[i], scan[i], *images, *sweeps));
  }
  return index;
}

}  // namespace sparsight
