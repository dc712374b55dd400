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

struct ImageSize {
  int width = 0;
  int height = 0;
  auto operator<=>(const ImageSize&) const = default;
};
// The size of most images, from a few of them: one of another size must not decide for all.
Result<ImageSize> image_size(const ImageFolder& images);

// Sets width and height; the principal point must lie within.
Result<CameraIntrinsics> with_image_size(CameraIntrinsics intrinsics, ImageSize size,
                                         const std::string& calibration_file);

// How many frames there are: up to the last image or scan, as a last image that is missing still
// has its scan. Every image must have its line in the file of times.
Result<std::size_t> frames_with_times(const ImageFolder& images,
                                      const std::map<std::uint64_t, std::filesystem::path>& scans,
                                      std::size_t times, const std::filesystem::path& times_file);

// Where file `number` is, or would be if it were not missing: named like the others.
std::filesystem::path numbered_file(const std::map<std::uint64_t, std::filesystem::path>& files,
                                    const std::filesystem::path& folder, std::uint64_t number,
                                    const std::string& default_extension);

}  // namespace sparsight
