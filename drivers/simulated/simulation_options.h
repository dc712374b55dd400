#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "hal/device.h"
#include "hal/rig_config.h"
#include "hal/time.h"

namespace sparsight {

enum class SimulatedScene : std::uint8_t { kCorridor, kHall, kStreet };

// What goes wrong on demand. Times count from the start of the simulation; shares are of 1.
struct SimulatedFaults {
  struct ClockJump {
    std::chrono::nanoseconds at{0};
    std::chrono::nanoseconds by{0};
  };
  struct Away {
    DeviceKind device = DeviceKind::kCamera;
    std::chrono::nanoseconds from{0};
    std::chrono::nanoseconds lasting{0};
  };
  // The lens is covered: frames come, and are dark.
  struct Covered {
    std::chrono::nanoseconds from{0};
    std::chrono::nanoseconds lasting{0};
  };
  // From one moment to the next the rig is where the walk would have brought it later, or had
  // brought it before.
  struct Carried {
    std::chrono::nanoseconds at{0};
    std::chrono::nanoseconds ahead{0};  // along the walk; negative: back
  };
  double lost_edges = 0.0;
  double lost_frames = 0.0;  // the driver's sequence shows the gap
  double lost_packets = 0.0;
  std::optional<ClockJump> lidar_clock_jump;
  std::vector<Away> away;
  std::vector<Covered> covered;
  std::vector<Carried> carried;
};

enum class SimulatedLens : std::uint8_t { kMild, kRectified };

struct SimulationOptions {
  SimulatedScene scene = SimulatedScene::kCorridor;
  std::chrono::nanoseconds duration = std::chrono::seconds(60);
  std::uint64_t seed = 1;
  HostTime start{std::chrono::seconds(1000)};  // CLOCK_MONOTONIC when the simulation begins

  int width = 800;
  int height = 600;
  double rate_hz = 30.0;
  bool color = false;  // a Bayer pattern over the sensor
  SimulatedLens lens = SimulatedLens::kMild;
  std::chrono::microseconds exposure{4000};
  double exposure_drift = 0.0;  // brightness wanders by this share: 0.25 is a quarter up and down
  bool motion_blur = false;     // several looks per exposure; takes as many times as long
  double light_detail = 1.0;    // below 1 the light is coarser, and the world quicker to make
  double image_noise = 1.0;     // multiplies shot and readout noise

  double range_noise_m = 0.01;  // one sigma; the datasheet's 3 cm is the bound of it
  double lidar_clock_drift_ppm = 35.0;
  // Strongest sees along the middle of the beam; the others see all of its width, so that at an
  // edge there are two echoes.
  ReturnMode return_mode = ReturnMode::kStrongest;
  bool pps = true;  // wired to the LiDAR and to the host; without it the LiDAR's clock runs free

  SimulatedFaults faults;
};

}  // namespace sparsight
