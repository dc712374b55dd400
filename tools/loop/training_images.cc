#include "tools/loop/training_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <variant>

#include "drivers/simulated/simulated_rig.h"

namespace sparsight {
namespace {

namespace fs = std::filesystem;

bool is_image(const fs::path& file) {
  const fs::path ending = file.extension();
  return ending == ".png" || ending == ".jpg" || ending == ".jpeg" || ending == ".PNG" ||
         ending == ".JPG";
}

GreyImage grey_image(const cv::Mat& grey) {
  GreyImage image{.width = grey.cols, .height = grey.rows};
  for (int row = 0; row < grey.rows; ++row) {
    image.pixels.insert(image.pixels.end(), grey.ptr(row), grey.ptr(row) + grey.cols);
  }
  return image;
}

}  // namespace

Result<std::vector<GreyImage>> images_in_folder(const std::string& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->is_regular_file() && is_image(entry->path())) files.push_back(entry->path());
  }
  if (error) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: {}; give a folder with PNG or JPEG files",
                                                  folder, error.message()));
  }
  std::ranges::sort(files);
  std::vector<GreyImage> images;
  for (const fs::path& file : files) {
    cv::Mat grey;
    try {
      grey = cv::imread(file.string(), cv::IMREAD_GRAYSCALE);
    } catch (const cv::Exception&) {  // a size that no image has
      grey.release();
    }
    if (grey.empty()) {
      return fail(
          ErrorCode::kMalformed,
          fmt::format("{}: cannot be read as an image; repair or remove it", file.string()));
    }
    images.push_back(grey_image(grey));
  }
  if (images.empty()) {
    return fail(ErrorCode::kNotFound, fmt::format("{}: holds no PNG or JPEG file", folder));
  }
  return images;
}

std::vector<GreyImage> rendered_images(const RenderingPlan& plan) {
  SimulationOptions options;
  options.scene = plan.scene;
  options.seed = plan.seed;
  options.duration = std::chrono::nanoseconds(std::llround(1e9 * plan.duration_s));
  options.rate_hz = plan.rate_hz;
  options.width = plan.width;
  options.height = plan.height;
  options.light_detail = plan.light_detail;
  options.image_noise = 0.0;
  SimulatedRig rig(options);
  std::vector<GreyImage> images;
  while (const std::optional<RigEvent> event = rig.next()) {
    const auto* frame = std::get_if<std::shared_ptr<const CameraFrame>>(&*event);
    if (frame == nullptr) continue;
    const CameraFrame& seen = **frame;
    images.push_back({.width = seen.width,
                      .height = seen.height,
                      .pixels = {seen.bytes.begin(), seen.bytes.end()}});
  }
  return images;
}

}  // namespace sparsight
