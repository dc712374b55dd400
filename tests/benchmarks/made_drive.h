#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "hal/frame_source.h"
#include "slam/keyframe.h"
#include "slam/points/camera_returns.h"
#include "slam/tracking/photometry_config.h"
#include "tests/synthetic/scene.h"

namespace sparsight {

// What every benchmark works on: a few frames of a made scene with their true poses, at the image
// sizes of KITTI and of the hand-held rig. Rendered once per program; no file is read.
struct MadeDrive {
  static constexpr int kLevels = 4;
  static constexpr std::size_t kPoints = 700;

  synthetic::Scene scene;
  std::vector<SynchronizedFrame> frames;
  std::vector<Eigen::Isometry3d> T_world_camera;  // true
  PhotometryConfig photometry;                    // with brightness and gradient weights

  std::vector<CameraReturn> returns(std::size_t frame) const;
  // kPoints points (fewer if the scan does not hold so many), patches of every level, true pose.
  std::unique_ptr<Keyframe> keyframe(std::size_t frame) const;
};

enum MadeDriveName : int { kStreet = 0, kHall = 1 };

// Street: 1241 x 376, 64 rings, 1.2 m between frames. Hall: 800 x 600, 16 rings, hand-held.
const MadeDrive& made_drive(int name);

// Benchmarks over both: the argument is a MadeDriveName.
void each_drive(benchmark::internal::Benchmark* benchmark);

}  // namespace sparsight
