#include "tests/system/made_recording.h"

#include <cmath>
#include <stdexcept>

#include "tests/synthetic/dataset_writer.h"

namespace sparsight {
namespace {

synthetic::Scene half_size(const char* name) {
  synthetic::Scene scene = *synthetic::make_scene(name);
  scene.resize(scene.rig.camera.width / 2, scene.rig.camera.height / 2);
  std::get<synthetic::SpinningLidar>(scene.sensor).azimuth_limit_rad = 0.85;
  return scene;
}

// A test cannot go on without its data.
std::filesystem::path require(Result<std::filesystem::path> folder) {
  if (!folder) throw std::runtime_error(folder.error().message);
  return *folder;
}

}  // namespace

synthetic::Scene small_street() { return half_size("street"); }

synthetic::Scene small_corridor() { return half_size("corridor"); }

synthetic::Scene small_lights() {
  synthetic::Scene scene = half_size("lights");
  std::get<synthetic::SpinningLidar>(scene.sensor).azimuth_limit_rad = M_PI;
  return scene;
}

std::filesystem::path make_odometry_sequence(const synthetic::Scene& scene, std::size_t frames,
                                             const std::filesystem::path& root) {
  return require(synthetic::write_odometry_folder(scene, frames, root));
}

std::filesystem::path make_raw_drive(synthetic::Scene scene, std::size_t frames,
                                     const std::filesystem::path& root) {
  std::get<synthetic::SpinningLidar>(scene.sensor).motion_compensated = false;
  return require(synthetic::write_raw_folder(scene, frames, root));
}

}  // namespace sparsight
