#include "tools/doctor/overlay_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <utility>
#include <vector>

#include "slam/geometry/camera_model.h"
#include "tools/doctor/depth_edges.h"

namespace sparsight {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

constexpr Rgb kWhite{255, 255, 255};
constexpr Rgb kBlack{0, 0, 0};

// Red, yellow, green, cyan, blue on a logarithmic scale from 1 m to 40 m.
Rgb color_of(double depth_m) {
  const double place = 4.0 * std::clamp(std::log(depth_m) / std::log(40.0), 0.0, 1.0);
  const auto ramp = [&](double peak, double width) {
    const double level = std::clamp(width - std::abs(place - peak), 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255.0 * level));
  };
  return {ramp(0.0, 2.0), ramp(2.0, 2.0), ramp(4.0, 2.0)};
}

class Canvas {
 public:
  explicit Canvas(const SynchronizedFrame& frame) {
    image_ = frame.color.value_or(ColorImage{});
    if (!image_.empty()) return;
    image_ = {frame.grey.width, frame.grey.height, {}};
    image_.rgb.reserve(3 * frame.grey.pixels.size());
    // Darker, so that the dots stand out.
    for (const std::uint8_t grey : frame.grey.pixels) {
      image_.rgb.insert(image_.rgb.end(), 3, static_cast<std::uint8_t>(grey * 3 / 4));
    }
  }

  void dot(const Eigen::Vector2d& pixel, Rgb color) { ring(pixel, 0.0, 1.5, color); }
  // Of the pixels between the two radii.
  void ring(const Eigen::Vector2d& pixel, double inner, double outer, Rgb color) {
    const int u0 = static_cast<int>(std::lround(pixel.x()));
    const int v0 = static_cast<int>(std::lround(pixel.y()));
    const int reach = static_cast<int>(outer) + 1;
    for (int v = std::max(0, v0 - reach); v <= std::min(image_.height - 1, v0 + reach); ++v) {
      for (int u = std::max(0, u0 - reach); u <= std::min(image_.width - 1, u0 + reach); ++u) {
        const double radius = std::hypot(u - pixel.x(), v - pixel.y());
        if (radius >= inner && radius <= outer) put(u, v, color);
      }
    }
  }
  ColorImage take() { return std::move(image_); }

 private:
  void put(int u, int v, Rgb color) {
    const auto at = 3 * (static_cast<std::ptrdiff_t>(v) * image_.width + u);
    std::copy(color.begin(), color.end(), image_.rgb.begin() + at);
  }
  ColorImage image_;
};

}  // namespace

ColorImage draw_overlay(const SynchronizedFrame& frame, const RigCalibration& rig) {
  const DepthEdgeConfig config;
  const CameraModel camera(rig.camera);
  Canvas canvas(frame);
  Eigen::Vector2d pixel;
  for (const LidarReturn& r : frame.sweep.returns) {
    if (std::abs(r.from_exposure_ns) > config.most_from_exposure.count()) continue;
    const Eigen::Vector3d p = rig.T_camera_lidar * r.p_lidar.cast<double>();
    if (camera.project(p, pixel)) canvas.dot(pixel, color_of(p.z()));
  }
  for (const DepthEdge& edge : depth_edges(frame.sweep, rig, config)) {
    if (!camera.project(edge.p_camera, pixel)) continue;
    canvas.ring(pixel, 2.6, 5.4, kBlack);
    canvas.ring(pixel, 3.0, 4.6, kWhite);
  }
  return canvas.take();
}

Result<void> write_png(const std::filesystem::path& file, const ColorImage& image) {
  cv::Mat bgr(image.height, image.width, CV_8UC3);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    bgr.data[i - i % 3 + (2 - i % 3)] = image.rgb[i];
  }
  try {
    if (cv::imwrite(file.string(), bgr)) return {};
  } catch (const cv::Exception&) {  // what to say of it is the same
  }
  return fail(
      ErrorCode::kUnreadable,
      fmt::format("{}: cannot be written; does its folder exist, and does it end with .png?",
                  file.string()));
}

}  // namespace sparsight
