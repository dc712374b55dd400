#include "drivers/datasets/image_folder.h"

#include <fmt/format.h>

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

Result<CameraIntrinsics> with_image_size(CameraIntrinsics intrinsics, const ImageFolder& images) {
  Error last{};
  for (const auto& [number, file] : images.images) {
    auto image = read_file_bytes(file).and_then(
        [&](const std::string& bytes) { return decode_image(bytes, file.string()); });
    if (image) {
      intrinsics.width = image->grey.width;
      intrinsics.height = image->grey.height;
      return intrinsics;
    }
    last = std::move(image.error());
  }
  return fail(last.code, fmt::format("{}: none of the {} images can be read; the last one: {}",
                                     images.folder.string(), images.images.size(), last.message));
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
