#include "drivers/datasets/image_folder.h"

#include <fmt/format.h>

#include <algorithm>

#include "drivers/datasets/file_bytes.h"
#include "drivers/datasets/image_file.h"

namespace sparsight {
namespace fs = std::filesystem;
namespace {

constexpr int kCameras = 4;  // of the KITTI car

}  // namespace

Result<ImageFolder> find_image_folder(const fs::path& root, const std::string& prefix,
                                      const std::string& inner, std::optional<int> camera) {
  std::string present;
  for (int n = 0; n < kCameras; ++n) {
    const fs::path folder = root / fmt::format("{}{}", prefix, n) / inner;
    ImageFolder found{n, folder, list_numbered_files(folder, {".png", ".jpg", ".jpeg"})};
    if (found.images.empty()) continue;
    if (!camera || *camera == n) return found;
    present += fmt::format(" {}", n);
  }
  const std::string wanted = fmt::format("{}{}", prefix, camera ? std::to_string(*camera) : "N");
  return fail(ErrorCode::kNotFound,
              present.empty() ? fmt::format("{}: no images; looked for {}/NNNNNN.png (or .jpg)",
                                            root.string(), (fs::path(wanted) / inner).string())
                              : fmt::format("{}: no images of camera {} in {}; there are cameras{}",
                                            root.string(), camera.value_or(0), wanted, present));
}

Result<ImageSize> image_size(const ImageFolder& images) {
  constexpr std::size_t kEnough = 5;
  std::map<ImageSize, std::size_t> votes;
  std::size_t read = 0;
  Error last{};
  for (const auto& [number, file] : images.images) {
    auto image = read_file_bytes(file).and_then(
        [&path = file](const std::string& bytes) { return decode_image(bytes, path.string()); });
    if (image) {
      ++votes[{image->grey.width, image->grey.height}];
      if (++read == kEnough) break;
    } else {
      last = std::move(image.error());
    }
  }
  if (votes.empty()) {
    return fail(last.code, fmt::format("{}: none of the {} images can be read; the last one: {}",
                                       images.folder.string(), images.images.size(), last.message));
  }
  return std::max_element(votes.begin(), votes.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

Result<CameraIntrinsics> with_image_size(CameraIntrinsics intrinsics, ImageSize size,
                                         const std::string& calibration_file) {
  intrinsics.width = size.width;
  intrinsics.height = size.height;
  if (intrinsics.cx < 0 || intrinsics.cx > size.width || intrinsics.cy < 0 ||
      intrinsics.cy > size.height) {
    return fail(
        ErrorCode::kOutOfRange,
        fmt::format("{}: the principal point ({:.1f}, {:.1f}) lies outside the images of "
                    "{} x {} pixels; this is another camera's calibration, or the images "
                    "were resized",
                    calibration_file, intrinsics.cx, intrinsics.cy, size.width, size.height));
  }
  return intrinsics;
}

Result<std::size_t> frames_with_times(const ImageFolder& images,
                                      const std::map<std::uint64_t, fs::path>& scans,
                                      std::size_t times, const fs::path& times_file) {
  const auto& [last_image, last_file] = *images.images.rbegin();
  if (last_image >= times) {
    return fail(ErrorCode::kWrongSize,
                fmt::format("{}: {} lines, but {} is image {}; every image needs its line with a "
                            "time",
                            times_file.string(), times, last_file.string(), last_image));
  }
  const std::uint64_t last_scan = scans.empty() ? 0 : scans.rbegin()->first;
  return std::min(std::max(last_image, last_scan) + 1, std::uint64_t{times});
}

fs::path numbered_file(const std::map<std::uint64_t, fs::path>& files, const fs::path& folder,
                       std::uint64_t number, const std::string& default_extension) {
  const auto known = files.find(number);
  if (known != files.end()) return known->second;
  const fs::path like =
      files.empty() ? fs::path("000000" + default_extension) : files.begin()->second;
  return folder /
         fmt::format("{:0{}}{}", number, like.stem().string().size(), like.extension().string());
}

}  // namespace sparsight
