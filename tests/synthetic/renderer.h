#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>

#include "hal/calibration.h"
#include "hal/image.h"
#include "tests/synthetic/world.h"

namespace sparsight::synthetic {

// What a camera adds to the light it receives.
struct Imager {
  double noise_grey = 1.2;  // standard deviation
  double vignetting = 0.0;  // share of the light lost in the corners
  double exposure_s = 0.0;  // longer than zero blurs what moves
  int sub_exposures = 1;    // averaged over exposure_s
  // Gain and offset of a frame exposed at this time; none: 1 and 0.
  std::function<Eigen::Vector2d(double seconds)> brightness;
  std::uint64_t seed = 1;
  int threads = 1;  // does not change the result
};

// The image of the world at this time (middle of the exposure). The trajectory is the camera's.
GreyImage render(const World& world, const CameraIntrinsics& camera,
                 const std::function<Eigen::Isometry3d(double)>& T_world_camera, double seconds,
                 const Imager& imager);

// Distance along the optical axis in each pixel's centre, metres; infinite where nothing is seen.
std::vector<double> render_depth(const World& world, const CameraIntrinsics& camera,
                                 const Eigen::Isometry3d& T_world_camera, double seconds);

}  // namespace sparsight::synthetic
