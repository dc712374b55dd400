#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hal/calibration.h"
#include "hal/result.h"
#include "tests/synthetic/renderer.h"
#include "tests/synthetic/scanner.h"
#include "tests/synthetic/trajectory.h"
#include "tests/synthetic/world.h"

namespace sparsight::synthetic {

// A world, what moves through it, and what it carries.
struct Scene {
  std::string name;
  World world;
  Trajectory T_world_lidar;
  RigCalibration rig;
  DepthSensor sensor;
  Imager imager;
  double frame_rate_hz = 10.0;
  double start_s = 1.0;  // time of the first frame; a sweep begins before its exposure
  std::uint64_t seed = 1;

  double exposure_s(std::size_t frame) const {
    return start_s + static_cast<double>(frame) / frame_rate_hz;
  }
  Eigen::Isometry3d T_world_camera(double seconds) const {
    return T_world_lidar(seconds) * rig.T_camera_lidar.inverse();
  }
  // Keeps what the camera sees and changes only how finely.
  void resize(int width, int height);

  GreyImage image(std::size_t frame) const;
  Sweep sweep(std::size_t frame) const;
};

std::vector<std::string> scene_names();
// The same name and seed give the same scene, on any machine.
Result<Scene> make_scene(std::string_view name, std::uint64_t seed = 1);

}  // namespace sparsight::synthetic
