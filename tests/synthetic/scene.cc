#include "tests/synthetic/scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <map>

#include "tests/synthetic/scenes/scenes.h"

namespace sparsight::synthetic {
namespace {

using Maker = Scene (*)(std::uint64_t seed);

const std::map<std::string, Maker, std::less<>>& makers() {
  static const std::map<std::string, Maker, std::less<>> kMakers{
      {"street", make_street},     {"highway", make_highway}, {"lights", make_lights},
      {"corridor", make_corridor}, {"hall", make_hall},       {"desk", make_desk},
      {"exposure", make_exposure}};
  return kMakers;
}

}  // namespace

void Scene::resize(int width, int height) {
  CameraIntrinsics& camera = rig.camera;
  const double scale_x = static_cast<double>(width) / camera.width;
  const double scale_y = static_cast<double>(height) / camera.height;
  camera.fx *= scale_x;
  camera.fy *= scale_y;
  // The origin is a pixel's centre, so its corner is what scales.
  camera.cx = (camera.cx + 0.5) * scale_x - 0.5;
  camera.cy = (camera.cy + 0.5) * scale_y - 0.5;
  camera.width = width;
  camera.height = height;
}

GreyImage Scene::image(std::size_t frame) const {
  return render(
      world, rig.camera, [this](double seconds) { return T_world_camera(seconds); },
      exposure_s(frame), imager);
}

Sweep Scene::sweep(std::size_t frame) const {
  return scan(
      world, sensor, rig, [this](double seconds) { return T_world_lidar(seconds); },
      exposure_s(frame), seed);
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : makers()) names.push_back(name);
  return names;
}

Result<Scene> make_scene(std::string_view name, std::uint64_t seed) {
  const auto found = makers().find(name);
  if (found == makers().end()) {
    return fail(ErrorCode::kNotFound, fmt::format("there is no scene '{}'; there are {}", name,
                                                  fmt::join(scene_names(), ", ")));
  }
  Scene scene = found->second(seed);
  scene.name = name;
  scene.seed = seed;
  scene.imager.seed = seed;
  return scene;
}

}  // namespace sparsight::synthetic
