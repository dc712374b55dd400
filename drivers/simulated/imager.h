#pragma once

#include <cstdint>
#include <vector>

#include "drivers/simulated/simulation_options.h"
#include "hal/calibration.h"

namespace sparsight::simulated {

// From light to the bytes of a grey frame: exposure, vignetting, saturation, shot and readout
// noise. Thread-safe.
class Imager {
 public:
  Imager(const SimulationOptions& options, const CameraIntrinsics& camera, float gain);

  std::vector<std::uint8_t> expose(const std::vector<float>& light, std::uint64_t frame) const;

 private:
  float brightness(std::uint64_t frame) const;

  SimulationOptions options_;
  float gain_;
  std::vector<float> vignetting_;
  std::vector<float> noise_;  // of one sigma; a frame reads it from places of its own
};

}  // namespace sparsight::simulated
