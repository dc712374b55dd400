// Writes a made scene in the KITTI layouts, to look at and to try the estimator on.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <numbers>
#include <string>

#include "tests/synthetic/dataset_writer.h"
#include "tests/synthetic/overlay.h"
#include "tests/synthetic/scene.h"

namespace {

using namespace sparsight;
using namespace sparsight::synthetic;

struct Request {
  std::string scene;
  std::size_t frames = 100;
  std::filesystem::path output;
  std::uint64_t seed = 1;
  int rays = 0;
  bool raw = false;
  int width = 0;
  int height = 0;
  double rate_hz = 0.0;
  double field_deg = 360.0;
  int threads = 2;
  std::size_t overlay_every = 0;
};

void set_rays(Scene& scene, int rays) {
  auto* lidar = std::get_if<SpinningLidar>(&scene.sensor);
  if (lidar == nullptr || rays == 0) return;
  lidar->elevations_rad = (rays == 16 ? vlp16() : hdl64()).elevations_rad;
}

void apply(const Request& request, Scene& scene) {
  set_rays(scene, request.rays);
  if (auto* lidar = std::get_if<SpinningLidar>(&scene.sensor)) {
    lidar->motion_compensated = !request.raw;
    lidar->azimuth_limit_rad = request.field_deg / 360.0 * std::numbers::pi;
  }
  if (request.width > 0 && request.height > 0) scene.resize(request.width, request.height);
  if (request.rate_hz > 0.0) scene.frame_rate_hz = request.rate_hz;
  scene.imager.threads = request.threads;
}

int make(const Request& request) {
  auto scene = make_scene(request.scene, request.seed);
  if (!scene) {
    fmt::print(stderr, "{}\n", scene.error().message);
    return 2;
  }
  apply(request, *scene);
  const auto progress = [&](std::size_t frame) {
    if (request.overlay_every > 0 && frame % request.overlay_every == 0) {
      write_overlay(*scene, frame, request.output / fmt::format("overlay_{:04}.png", frame));
    }
    fmt::print(stderr, "\r{} of {} frames", frame + 1, request.frames);
  };
  const auto written =
      request.raw ? write_raw_folder(*scene, request.frames, request.output, progress)
                  : write_odometry_folder(*scene, request.frames, request.output, progress);
  if (!written) {
    fmt::print(stderr, "\n{}\n", written.error().message);
    return 1;
  }
  fmt::print(stderr, "\n");
  fmt::print("{}\n", written->string());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Request request;
  CLI::App app("Writes a made scene, with exact poses, as a KITTI odometry or raw folder");
  app.add_option("--scene", request.scene)->required()->check(CLI::IsMember(scene_names()));
  app.add_option("--frames", request.frames)->capture_default_str();
  app.add_option("--output", request.output, "folder to make")->required();
  app.add_option("--seed", request.seed)->capture_default_str();
  app.add_option("--rays", request.rays, "64 or 16 rings; else as the scene's sensor has")
      ->check(CLI::IsMember({64, 16}));
  app.add_flag("--raw", request.raw, "KITTI raw layout, scans as measured on the move");
  app.add_option("--width", request.width, "pixels, with --height; the field of view stays");
  app.add_option("--height", request.height);
  app.add_option("--rate", request.rate_hz, "frames per second");
  app.add_option("--field", request.field_deg, "degrees of azimuth stored")->capture_default_str();
  app.add_option("--threads", request.threads)->capture_default_str();
  app.add_option("--overlay", request.overlay_every,
                 "every so many frames, also a picture of the scan drawn over the image");
  CLI11_PARSE(app, argc, argv);
  return make(request);
}
