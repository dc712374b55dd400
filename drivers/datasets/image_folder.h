#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "hal/calibration.h"
#include "hal/result.h"

namespace sparsight {

// The numbered images of one camera.
struct ImageFolder {
  int camera = 0;
  std::filesystem::path folder;
  std::map<std::uint64_t, std::filesystem::path> images;  // by frame number; not empty
};

// Picks the folder of camera N, or the lowest one that has images. Folders are named
// root / (prefix + N) / inner.
Result<ImageFolder> find_image_folder(const std::filesystem::path& root, const std::string& prefix,
                                      const std::string& inner, std::optional<int> camera);

// Sets width and height from the first image that can be read.
Result<CameraIntrinsics> with_image_size(CameraIntrinsics intrinsics, const ImageFolder& images);

// Where file `number` is, or would be if it were not missing: named like the others.
std::filesystem::path numbered_file(const std::map<std::uint64_t, std::filesystem::path>& files,
                                    const std::filesystem::path& folder, std::uint64_t number,
                                    const std::string& default_extension);

}  // namespace sparsight
